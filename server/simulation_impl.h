// The simulation thread: its state and what it does, by file: simulation.cpp the loop, simulation_load.cpp scenes,
// simulation_jobs.cpp runs, simulation_mutations.cpp the other commands.
#pragma once

#include <omp.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "server/at_rest.h"
#include "server/deferred_parameters.h"
#include "server/job.h"
#include "server/loader.h"
#include "server/probe_watch.h"
#include "server/publish/frame_hub.h"
#include "server/scene/run.h"
#include "server/scene_events.h"
#include "server/simulation.h"
#include "server/status_writer.h"
#include "server/team_choice.h"

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;
using proto::Reply;
using proto::Result;
using proto::SimState;

// Everything here runs on the simulation thread, except post, wake and stop of the Simulation.
struct Simulation::Impl {
    Impl(const SimulationOptions& options, Outbox& replies, EventLog& event_log, JobBoard& job_board,
         StatusBoard& status_board, ProbeBoard& probe_board, publish::FrameHub& frame_hub)
        : threads(options.threads > 0 ? options.threads : omp_get_num_procs()),
          data_folder(options.data_folder),
          outbox(replies),
          events(event_log),
          jobs(job_board),
          hub(frame_hub),
          status(status_board),
          probes(probe_board) {}

    // ---- the loop (simulation.cpp) ----------------------------------------------------------------------------------

    void run_thread();
    // One turn: what waits in the inbox, frames that somebody wants now, then a step or a sleep.
    void turn();
    void sleep();
    void step();
    void capture_due();
    void sample_probes();

    Place place() const { return run ? Place{run->step_number(), run->time()} : Place{}; }
    proto::Applied applied() const { return {place().step, place().time, {}}; }
    SimState state() const;
    void write_status();
    void report(std::string type, std::string message, std::map<std::string, proto::EventValue> data = {},
                bool with_objects = false);
    proto::StateHash refresh_hash();

    bool watches_rest() const { return job->until_at_rest || scene_events.wait_for_rest(*run); }
    // An event of the scene that waits for rest must not wait for ever unnoticed.
    void report_overdue_rest();
    void fire_scene_events();
    proto::Status act(const proto::RemoveObjectAction& action);
    proto::Status act(const proto::MoveObjectAction& action);
    proto::Status act(const proto::SetParametersAction& action);
    proto::Status act(const proto::PauseAction& action);

    // The run stops before garbage spreads; the state is kept for inspection, nobody waits in vain.
    void fault(const proto::FaultReport& found);
    // An exception in our own code.
    void give_up(const std::string& what);
    void say_goodbye();

    // ---- answers ----------------------------------------------------------------------------------------------------

    // Answers a refusal; true when the method may go on.
    bool is_allowed(Token token, std::string_view method);

    template <class Value>
    void answer(Token token, Value value) {
        write_status();  // who reads the status after the reply sees the change
        outbox.put(token, Reply(std::move(value)));
    }
    // Answers a mutation of the run: its error, or where it was applied.
    void answer(Token token, const proto::Status& outcome);

    // ---- scenes (simulation_load.cpp) -------------------------------------------------------------------------------

    void apply(Token token, proto::SceneLoad load);
    void apply(Token token, proto::SimReset);
    void apply(Token, LoadFinished load);
    void start_load(Token token, const proto::SceneDesc& scene, bool is_reset);
    proto::SceneLoadReply load_reply() const;

    // ---- runs (simulation_jobs.cpp) ---------------------------------------------------------------------------------

    void apply(Token token, proto::SimStep request);
    void apply(Token token, proto::SimRun request);
    void apply(Token token, proto::SimPause);
    void apply(Token token, proto::SimResume);
    void apply(Token token, proto::SimCancel);
    void start_job(Token token, const proto::RunUntil& until, std::optional<double> pace, bool wait);
    void announce(const char* type, std::string message);
    void pause_job();
    bool end_job_if_done();
    void end_job(Job ended, const Job::End& end);
    void end_all_jobs(const Job::End& end);
    // Rest is counted from here: what happened in between was not watched.
    void restart_rest_watch();

    // ---- the other commands (simulation_mutations.cpp) --------------------------------------------------------------

    void apply(InboxItem item);
    void apply(Token token, proto::ParamsSet request);
    void apply(Token token, const proto::ObjectsAdd& request);
    void apply(Token token, const proto::ObjectsMove& request);
    void apply(Token token, const proto::ObjectsRemove& request);
    void apply(Token token, const proto::ProbesAdd& request);
    void apply(Token token, const proto::ProbesRemove& request);
    void apply(Token token, const proto::SimInspect& request);
    void apply(Token token, HashWanted);
    void apply(Token token, proto::ServerShutdown);
    void set_parameters(Token token, const proto::Parameters& values);
    proto::Result<proto::ParamsSetReply> change_parameters(const proto::Parameters& values);
    void apply_due_parameters();
    void refuse_deferred(const Error& error);
    proto::Status change_objects(proto::Status outcome, const char* event, const std::string& name);

    // ---- state ------------------------------------------------------------------------------------------------------

    const int threads;
    const std::filesystem::path data_folder;
    Outbox& outbox;
    EventLog& events;
    JobBoard& jobs;
    publish::FrameHub& hub;
    StatusWriter status;
    ProbeWatch probes;
    Inbox inbox;

    std::shared_ptr<scene::Run> run;
    TeamChoice team{threads};  // of its steps
    Loader loader;
    Token load_token{0};
    std::vector<Token> load_cancels;

    std::optional<Job> job;     // the running one
    std::optional<Job> paused;  // the paused one
    std::optional<proto::JobReply> last_job;
    std::uint64_t last_job_number{0};
    DeferredParameters deferred;

    std::optional<AtRestWatch> at_rest;
    bool is_at_rest{false};
    double frame_seconds{0.0};  // [s] wall time spent in copying frames since the run began
    bool is_overdue_reported{false};
    bool is_faulted{false};
    bool stalled{false};
    SceneEvents scene_events;

    std::atomic<bool> stopping{false};
    std::mutex gate;  // between post and stop: nothing is posted that nobody will answer
    bool is_closed{false};
    std::thread thread;
};

}  // namespace headrace::server
