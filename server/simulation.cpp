#include "server/simulation.h"

#include <omp.h>

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "server/at_rest.h"
#include "server/fault_report.h"
#include "server/job.h"
#include "server/loader.h"
#include "server/publish/frame_builder.h"
#include "server/publish/frame_hub.h"
#include "server/scene/run.h"
#include "server/scene/validate.h"
#include "server/state_table.h"
#include "server/status_writer.h"

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;
using proto::Reply;
using proto::Result;
using proto::SimState;

namespace {

const char* ended_message(proto::JobState state) {
    switch (state) {
        case proto::JobState::finished:
            return "finished";
        case proto::JobState::cancelled:
            return "cancelled";
        case proto::JobState::timed_out:
            return "timed out";
        case proto::JobState::faulted:
            return "faulted";
        default:
            return "ended";
    }
}

}  // namespace

// Everything below runs on the simulation thread, except post, wake and stop.
struct Simulation::Impl {
    Impl(const SimulationOptions& options, Outbox& replies, EventLog& event_log, JobBoard& job_board,
         StatusBoard& status_board, publish::FrameHub& frame_hub)
        : threads(options.threads > 0 ? options.threads : omp_get_num_procs()),
          outbox(replies),
          events(event_log),
          jobs(job_board),
          hub(frame_hub),
          status(status_board) {}

    // ---- the loop ---------------------------------------------------------------------------------------------------

    void run_thread() {
        omp_set_num_threads(threads);
        while (!stopping) {
            try {
                turn();
            } catch (const std::exception& problem) {
                give_up(problem.what());
            }
        }
        say_goodbye();
    }

    // One turn: what waits in the inbox, frames that somebody wants now, then a step or a sleep.
    void turn() {
        while (auto item = inbox.take()) apply(std::move(*item));
        capture_due();
        if (!job || stopping) return sleep();
        if (end_job_if_done()) return;
        stalled = !hub.may_step();
        if (stalled) {
            job->restart_pace(place());  // time lost to a reader is not caught up
            return sleep();
        }
        if (const auto begin = job->next_step_at(place(), run->model().time_step()); begin && Clock::now() < *begin) {
            write_status();
            return inbox.wait_until(*begin);
        }
        step();
    }

    void sleep() {
        write_status();
        if (loader.is_loading())
            inbox.wait_until(Clock::now() + std::chrono::milliseconds(100));  // the progress is on the board
        else if (!stopping)
            inbox.wait();
    }

    void step() {
        if (run->step_number() == 0) fire_scene_events();  // those of step 0 and time 0
        if (!job) return;                                  // paused by one of them
        apply_due_parameters();
        const solver::StepReport& report = run->step();
        if (report.fault) {
            capture_due();  // who asked for frames sees the state that faulted
            return fault(report_of(*report.fault, place()));
        }
        is_at_rest = watches_rest() && at_rest->update(*run);
        fire_scene_events();
        report_overdue_rest();
        capture_due();
        if (!end_job_if_done()) write_status();
    }

    void capture_due() {
        if (!run) return;
        const publish::Moment now{run->step_number(), run->time(), Clock::now()};
        hub.capture_due(now, [&](proto::FieldSet fields, proto::Precision precision) {
            return publish::copy_fields(run->particles(), fields, precision, now, hub.generation());
        });
    }

    Place place() const { return run ? Place{run->step_number(), run->time()} : Place{}; }
    proto::Applied applied() const { return {place().step, place().time}; }

    SimState state() const {
        if (loader.is_loading()) return SimState::loading;
        if (!run) return SimState::empty;
        if (is_faulted) return SimState::faulted;
        return job ? SimState::running : SimState::idle;
    }

    void write_status() {
        SimulationView view{state(), run.get(), last_job, stalled, loader.progress()};
        if (job)
            view.job = job->reply(proto::JobState::running, "", place());
        else if (paused)
            view.job = paused->reply(proto::JobState::paused, "", place());
        status.write(view);
    }

    void report(std::string type, std::string message, std::map<std::string, proto::EventValue> data = {},
                bool with_objects = false) {
        proto::Event event;
        event.type = std::move(type);
        event.step = place().step;
        event.time = place().time;
        event.message = std::move(message);
        event.data = std::move(data);
        if (with_objects) event.objects = run->objects();
        events.add(std::move(event));
    }

    // ---- mutations --------------------------------------------------------------------------------------------------

    void apply(InboxItem item) {
        try {
            std::visit([&](auto&& mutation) { apply(item.token, std::forward<decltype(mutation)>(mutation)); },
                       std::move(item.mutation));
        } catch (const std::exception& problem) {
            outbox.put(item.token, Error{ErrorCode::internal_error, problem.what(), "", "report this as a bug"});
        }
    }

    // Answers a refusal; true when the method may go on.
    bool is_allowed(Token token, std::string_view method) {
        const auto refusal = refuse_in_state(method, state());
        if (refusal) outbox.put(token, *refusal);
        return !refusal;
    }

    template <class Value>
    void answer(Token token, Value value) {
        write_status();  // who reads the status after the reply sees the change
        outbox.put(token, Reply(std::move(value)));
    }

    // Answers a mutation of the run: its error, or where it was applied.
    void answer(Token token, const proto::Status& outcome) {
        if (outcome)
            answer(token, applied());
        else
            outbox.put(token, outcome.error());
    }

    void apply(Token token, proto::SceneLoad load) {
        if (is_allowed(token, "scene.load")) start_load(token, std::get<proto::SceneDesc>(load.scene), false);
    }

    void apply(Token token, proto::SimReset) {
        if (is_allowed(token, "sim.reset")) start_load(token, run->scene(), true);
    }

    void start_load(Token token, const proto::SceneDesc& scene, bool is_reset) {
        load_token = token;
        loader.start(scene, threads, [this, is_reset](Result<std::shared_ptr<scene::Run>> built) {
            inbox.put(0, LoadFinished{std::move(built), is_reset});
        });
        write_status();
    }

    void apply(Token, LoadFinished load) {
        loader.finish();
        const Token token = std::exchange(load_token, 0);
        const std::vector<Token> cancels = std::exchange(load_cancels, {});
        // A cancel that came when the work was nearly done still holds.
        if (!cancels.empty() && load.run) load.run = scene::cancelled_error();
        if (!load.run) {
            report("scene.load_failed", load.run.error().message, {{"path", load.run.error().path}});
            write_status();
            outbox.put(token, load.run.error());
            for (const Token cancel : cancels) outbox.put(cancel, Reply(applied()));
            return;
        }
        if (paused) end_job(*std::exchange(paused, std::nullopt), {proto::JobState::cancelled, "another scene"});
        refuse_deferred({ErrorCode::cancelled, "another scene was loaded before that step", "params.at_step", ""});
        run = std::move(*load.run);
        is_faulted = is_at_rest = is_overdue_reported = false;
        fired.clear();
        at_rest.emplace(*run);
        status.forget_run();
        status.refresh_lists(*run);
        status.set_hash(solver::compute_state_hash(run->particles()), 0);
        hub.restart();
        report("scene.loaded", run->scene().name + (load.is_reset ? ", reset" : ""), {{"scene", run->scene().name}},
               true);
        answer(token, load_reply());
    }

    proto::SceneLoadReply load_reply() const {
        proto::SceneLoadReply reply;
        reply.scene = run->scene().name;
        reply.step = place().step;
        reply.time = place().time;
        reply.particles = static_cast<std::int64_t>(run->particles().size());
        reply.time_step = run->model().time_step();
        reply.state = state();
        for (const proto::ObjectDesc& object : run->objects()) reply.objects.push_back(object.name);
        return reply;
    }

    void apply(Token token, proto::SimStep request) {
        if (!is_allowed(token, "sim.step")) return;
        proto::RunUntil until;
        until.steps = request.steps;
        start_job(token, until, std::nullopt, true);
    }

    void apply(Token token, proto::SimRun request) {
        if (!is_allowed(token, "sim.run")) return;
        if (paused) {
            outbox.put(token, Error{ErrorCode::wrong_state, "job " + std::to_string(paused->number) + " is paused", "",
                                    "sim.resume continues it, sim.cancel ends it"});
            return;
        }
        start_job(token, request.until, request.pace, request.wait);
    }

    void start_job(Token token, const proto::RunUntil& until, std::optional<double> pace, bool wait) {
        stalled = false;
        job = Job::make(++last_job_number, until, place(), run->scene().at_rest.timeout);
        job->pace = pace;
        restart_rest_watch();
        announce("job.started", "job " + std::to_string(job->number) + " started");
        if (wait)
            job->waiting.push_back(token);
        else
            answer(token, job->reply(proto::JobState::running, "", place()));
    }

    void announce(const char* type, std::string message) {
        const auto reply = job->reply(proto::JobState::running, "", place());
        jobs.write(reply);
        write_status();
        report(type, std::move(message), {{"job", static_cast<std::int64_t>(reply.job)}});
    }

    void apply(Token token, proto::SimPause) {
        if (!is_allowed(token, "sim.pause")) return;
        pause_job();
        answer(token, applied());
    }

    void pause_job() {
        if (!job) return;
        if (paused) {  // single steps while another job is paused: these end, the other stays
            end_job(*std::exchange(job, std::nullopt), {proto::JobState::cancelled, "paused"});
            return;
        }
        job->pause();
        paused = std::exchange(job, std::nullopt);
        stalled = false;
        hub.not_stepping();
        last_job = paused->reply(proto::JobState::paused, "", place());
        jobs.write(*last_job);
        refresh_hash();
        write_status();
        report("job.paused", "job " + std::to_string(paused->number) + " paused",
               {{"job", static_cast<std::int64_t>(paused->number)}});
    }

    void apply(Token token, proto::SimResume) {
        if (!is_allowed(token, "sim.resume")) return;
        if (!job && !paused) return start_job(token, {}, std::nullopt, false);
        if (!job) {
            job = std::exchange(paused, std::nullopt);
            job->resume(place());
            restart_rest_watch();
            announce("job.resumed", "job " + std::to_string(job->number) + " resumed");
        }
        answer(token, job->reply(proto::JobState::running, "", place()));
    }

    void apply(Token token, proto::SimCancel) {
        if (loader.is_loading()) {
            loader.cancel();
            load_cancels.push_back(token);  // answered when the worker has stopped
            return;
        }
        end_all_jobs({proto::JobState::cancelled, "cancelled"});
        answer(token, applied());
    }

    void apply(Token token, proto::ParamsSet request) {
        if (!is_allowed(token, "params.set")) return;
        const std::uint64_t now = run->step_number();
        if (!request.at_step || static_cast<std::uint64_t>(*request.at_step) == now)
            return set_parameters(token, request.parameters);
        if (static_cast<std::uint64_t>(*request.at_step) < now) {
            outbox.put(token, Error{ErrorCode::invalid_params,
                                    "step " + std::to_string(*request.at_step) + " is past; the next one is " +
                                        std::to_string(now),
                                    "params.at_step", "name a step to come, or leave it out"});
            return;
        }
        if (deferred.size() >= kMostDeferred) {
            outbox.put(token, Error{ErrorCode::limit_exceeded, "too many changes are waiting for their step",
                                    "params.at_step", "wait for some of them"});
            return;
        }
        // Refused now rather than at its step, if it can be known now.
        if (const auto refusal = solver::check_parameters(run->model().parameter_table(), request.parameters))
            return set_parameters(token, request.parameters);
        deferred.emplace(static_cast<std::uint64_t>(*request.at_step), std::pair{token, std::move(request.parameters)});
    }

    void set_parameters(Token token, const proto::Parameters& values) {
        proto::ParamsSetReply reply{place().step, place().time, {}};
        if (const proto::Status outcome = run->set_parameters(values, &reply.previous); !outcome) {
            outbox.put(token, outcome.error());
            return;
        }
        std::string names;
        for (const auto& [name, value] : values) names += (names.empty() ? "" : ", ") + name;
        status.refresh_lists(*run);
        report("params.changed", "changed: " + names, {{"parameters", names}});
        answer(token, std::move(reply));
    }

    void apply_due_parameters() {
        while (!deferred.empty() && deferred.begin()->first <= run->step_number()) {
            const auto [token, values] = std::move(deferred.begin()->second);
            deferred.erase(deferred.begin());
            set_parameters(token, values);
        }
    }

    void refuse_deferred(const Error& error) {
        for (const auto& [step, change] : std::exchange(deferred, {})) outbox.put(change.first, error);
    }

    void apply(Token token, const proto::ObjectsAdd& request) {
        if (!is_allowed(token, "objects.add")) return;
        answer(token, change_objects(run->add_object(request.object), "object.added", request.object.name));
    }

    void apply(Token token, const proto::ObjectsMove& request) {
        if (!is_allowed(token, "objects.move")) return;
        answer(token,
               change_objects(run->move_object(request.name, request.to, request.by), "object.moved", request.name));
    }

    void apply(Token token, const proto::ObjectsRemove& request) {
        if (!is_allowed(token, "objects.remove")) return;
        answer(token, change_objects(run->remove_object(request.name), "object.removed", request.name));
    }

    proto::Status change_objects(proto::Status outcome, const char* event, const std::string& name) {
        if (!outcome) return outcome;
        status.refresh_lists(*run);
        report(event, name, {{"name", name}}, true);
        return outcome;
    }

    void apply(Token token, HashWanted) {
        if (!run) {
            outbox.put(token,
                       Error{ErrorCode::wrong_state, "no scene is loaded", "", "load a scene first (scene.load)"});
            return;
        }
        answer(token, refresh_hash());
    }

    void apply(Token token, proto::ServerShutdown) {
        if (job) end_job(*std::exchange(job, std::nullopt), {proto::JobState::cancelled, "the server stops"});
        answer(token, applied());
    }

    // ---- ends -------------------------------------------------------------------------------------------------------

    bool end_job_if_done() {
        if (!job) return false;
        const auto end = job->end(place(), run->model().time_step(), is_at_rest);
        if (!end) return false;
        if (job->until_at_rest && end->state == proto::JobState::finished && is_at_rest)
            report("sim.at_rest", "the fluid is at rest", {{"job", static_cast<std::int64_t>(job->number)}});
        end_job(*std::exchange(job, std::nullopt), *end);
        return true;
    }

    void end_job(Job ended, const Job::End& end) {
        if (ended.is_running) ended.pause();
        stalled = false;
        hub.not_stepping();
        refresh_hash();
        last_job = ended.reply(end.state, end.reason, place());
        jobs.write(*last_job);
        write_status();
        report("job.ended", "job " + std::to_string(ended.number) + " " + ended_message(end.state) + ": " + end.reason,
               {{"job", static_cast<std::int64_t>(ended.number)}, {"reason", end.reason}});
        for (const Token token : ended.waiting) outbox.put(token, Reply(*last_job));
    }

    // The run stops before garbage spreads; the state is kept for inspection, nobody waits in vain.
    void fault(const proto::FaultReport& found) {
        is_faulted = true;
        status.set_fault(found);
        report("sim.faulted", message_of(found),
               {{"criterion", found.criterion},
                {"particle", static_cast<std::int64_t>(found.particle)},
                {"remedy", found.remedy}});
        refuse_deferred(
            {ErrorCode::faulted, "the run has faulted before that step", "params.at_step", "sim.reset or scene.load"});
        end_all_jobs({proto::JobState::faulted, found.criterion + "; " + found.remedy});
    }

    void end_all_jobs(const Job::End& end) {
        if (job) end_job(*std::exchange(job, std::nullopt), end);
        if (paused) end_job(*std::exchange(paused, std::nullopt), end);
    }

    // An exception in our own code.
    void give_up(const std::string& what) {
        if (run && job) return fault(report_of_internal_error(what, place()));
        report("server.problem", "simulation: " + what);
        inbox.wait_until(Clock::now() + std::chrono::milliseconds(100));  // should it come again: no busy loop
    }

    void say_goodbye() {
        const Error error{ErrorCode::shutting_down, "the server is shutting down", "", "start it again"};
        loader.cancel();
        loader.finish();
        if (job)
            for (const Token token : job->waiting) outbox.put(token, error);
        if (paused)
            for (const Token token : paused->waiting) outbox.put(token, error);
        outbox.put(load_token, error);
        for (const Token cancel : load_cancels) outbox.put(cancel, Reply(applied()));
        refuse_deferred(error);
        while (auto item = inbox.take()) outbox.put(item->token, error);
    }

    // ---- rest, scene events, hash -----------------------------------------------------------------------------------

    // Rest is counted from here: what happened in between was not watched.
    void restart_rest_watch() {
        if (job->until_at_rest) at_rest.emplace(*run);
        is_at_rest = false;
    }

    bool watches_rest() const { return job->until_at_rest || waits_for_rest(); }

    // Is there an event of the scene that waits for rest?
    bool waits_for_rest() const {
        for (std::size_t k = 0; k < run->scene().events.size(); ++k)
            if (run->scene().events[k].at_rest && !fired.contains(k)) return true;
        return false;
    }

    // An event of the scene that waits for rest must not wait for ever unnoticed.
    void report_overdue_rest() {
        if (is_overdue_reported || !waits_for_rest() || !at_rest->is_overdue(*run)) return;
        is_overdue_reported = true;
        report("sim.not_at_rest", "an event of the scene waits for rest; its at_rest.timeout has passed",
               {{"timeout", run->scene().at_rest.timeout}});
    }

    void fire_scene_events() {
        const auto& list = run->scene().events;
        bool has_acted_on_rest = false;
        for (std::size_t k = 0; k < list.size(); ++k) {
            if (fired.contains(k)) continue;
            const proto::SceneEventDesc& event = list[k];
            const bool is_due = (event.at_rest && is_at_rest) ||
                                (event.time && run->time() >= *event.time * (1 - 1e-12)) ||
                                (event.step && run->step_number() >= static_cast<std::uint64_t>(*event.step));
            if (!is_due) continue;
            fired.insert(k);
            has_acted_on_rest |= event.at_rest;
            report("scene_event.fired", "scene event " + std::to_string(k), {{"event", static_cast<std::int64_t>(k)}});
            std::visit([this](const auto& action) { act(action); }, event.action);
        }
        if (!has_acted_on_rest) return;
        // What the event did may end the rest (it removes the panel): a run until at rest goes on to the next one.
        is_at_rest = false;
        at_rest.emplace(*run);
    }

    void act(const proto::RemoveObjectAction& action) { apply(0, proto::ObjectsRemove{action.name}); }
    void act(const proto::MoveObjectAction& action) { apply(0, proto::ObjectsMove{action.name, action.to, {}}); }
    void act(const proto::SetParametersAction& action) { apply(0, proto::ParamsSet{action.parameters, {}}); }
    void act(const proto::PauseAction&) { pause_job(); }

    proto::StateHash refresh_hash() {
        return status.set_hash(solver::compute_state_hash(run->particles()), run->step_number());
    }

    static constexpr std::size_t kMostDeferred = 1'000;

    const int threads;
    Outbox& outbox;
    EventLog& events;
    JobBoard& jobs;
    publish::FrameHub& hub;
    StatusWriter status;
    Inbox inbox;

    std::shared_ptr<scene::Run> run;
    Loader loader;
    Token load_token{0};
    std::vector<Token> load_cancels;

    std::optional<Job> job;     // the running one
    std::optional<Job> paused;  // the paused one
    std::optional<proto::JobReply> last_job;
    std::uint64_t last_job_number{0};
    std::multimap<std::uint64_t, std::pair<Token, proto::Parameters>> deferred;  // by step

    std::optional<AtRestWatch> at_rest;
    bool is_at_rest{false};
    bool is_overdue_reported{false};
    bool is_faulted{false};
    bool stalled{false};
    std::set<std::size_t> fired;  // scene events

    std::atomic<bool> stopping{false};
    std::mutex gate;  // between post and stop: nothing is posted that nobody will answer
    bool is_closed{false};
    std::thread thread;
};

Simulation::Simulation(const SimulationOptions& options, Outbox& outbox, EventLog& events, JobBoard& jobs,
                       StatusBoard& board, publish::FrameHub& hub)
    : impl_(std::make_unique<Impl>(options, outbox, events, jobs, board, hub)) {}

Simulation::~Simulation() {
    stop();
}

void Simulation::start() {
    impl_->thread = std::thread([impl = impl_.get()] { impl->run_thread(); });
}

void Simulation::stop() {
    {
        const std::lock_guard lock(impl_->gate);
        impl_->is_closed = true;
    }
    impl_->stopping = true;
    impl_->inbox.wake();
    if (impl_->thread.joinable()) impl_->thread.join();
}

void Simulation::post(Token token, Mutation mutation) {
    const std::lock_guard lock(impl_->gate);
    if (impl_->is_closed)
        impl_->outbox.put(token, Error{ErrorCode::shutting_down, "the server is shutting down", "", "start it again"});
    else
        impl_->inbox.put(token, std::move(mutation));
}

void Simulation::wake() {
    impl_->inbox.wake();
}

}  // namespace headrace::server
