// The loop of the simulation thread, faults and ends, and the way in from other threads.
#include "server/simulation.h"

#include <algorithm>
#include <exception>

#include "server/fault_report.h"
#include "server/publish/frame_builder.h"
#include "server/simulation_impl.h"
#include "server/solver/parallel.h"

namespace headrace::server {

void Simulation::Impl::run_thread() {
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

void Simulation::Impl::turn() {
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

void Simulation::Impl::sleep() {
    write_status();
    if (loader.is_loading())
        inbox.wait_until(Clock::now() + std::chrono::milliseconds(100));  // the progress is on the board
    else if (!stopping)
        inbox.wait();
}

void Simulation::Impl::step() {
    if (run->step_number() == 0) fire_scene_events();  // those of step 0 and time 0
    if (!job) return;                                  // paused by one of them
    apply_due_parameters();
    solver::team_limit = team.threads();
    const auto start = Clock::now();
    const solver::StepReport& report = run->step();
    team.note(std::chrono::duration<double>(Clock::now() - start).count());
    if (report.fault) {
        capture_due();  // who asked for frames sees the state that faulted
        return fault(report_of(*report.fault, place()));
    }
    is_at_rest = watches_rest() && at_rest->update(*run);
    sample_probes();
    fire_scene_events();
    report_overdue_rest();
    capture_due();
    if (!end_job_if_done()) write_status();
}

void Simulation::Impl::capture_due() {
    if (!run) return;
    const publish::Moment now{run->step_number(), run->time(), Clock::now()};
    hub.capture_due(now, [&](proto::FieldSet fields, proto::Precision precision) {
        const auto start = Clock::now();
        auto capture = publish::copy_fields(run->particles(), fields, precision, now, hub.generation());
        frame_seconds += std::chrono::duration<double>(Clock::now() - start).count();
        return capture;
    });
}

void Simulation::Impl::sample_probes() {
    for (const auto& [name, why] : probes.sample(*run))
        report("probe.failed", "probe " + name + " cannot be evaluated: " + why, {{"probe", name}});
}

SimState Simulation::Impl::state() const {
    if (loader.is_loading()) return SimState::loading;
    if (!run) return SimState::empty;
    if (is_faulted) return SimState::faulted;
    return job ? SimState::running : SimState::idle;
}

void Simulation::Impl::write_status() {
    SimulationView view{state(),           run.get(), team.threads(), last_job,     stalled,
                        loader.progress(), &probes,   hub.demands(),  frame_seconds};
    if (job)
        view.job = job->reply(proto::JobState::running, "", place());
    else if (paused)
        view.job = paused->reply(proto::JobState::paused, "", place());
    status.write(view);
}

void Simulation::Impl::report(std::string type, std::string message, std::map<std::string, proto::EventValue> data,
                              bool with_objects) {
    proto::Event event;
    event.type = std::move(type);
    event.step = place().step;
    event.time = place().time;
    event.message = std::move(message);
    event.data = std::move(data);
    if (with_objects) event.objects = run->objects();
    events.add(std::move(event));
}

void Simulation::Impl::fault(const proto::FaultReport& found) {
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

void Simulation::Impl::give_up(const std::string& what) {
    if (run && job) return fault(report_of_internal_error(what, place()));
    report("server.problem", "simulation: " + what);
    inbox.wait_until(Clock::now() + std::chrono::milliseconds(100));  // should it come again: no busy loop
}

void Simulation::Impl::say_goodbye() {
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

void Simulation::Impl::report_overdue_rest() {
    if (is_overdue_reported || !scene_events.wait_for_rest(*run) || !at_rest->is_overdue(*run)) return;
    is_overdue_reported = true;
    report("sim.not_at_rest", "an event of the scene waits for rest; its at_rest.timeout has passed",
           {{"timeout", run->scene().at_rest.timeout}});
}

void Simulation::Impl::fire_scene_events() {
    bool has_acted_on_rest = false;
    for (const std::size_t k : scene_events.take_due(*run, probes.probes(), is_at_rest)) {
        const proto::SceneEventDesc& event = run->scene().events[k];
        has_acted_on_rest |= event.at_rest;
        report("scene_event.fired", "scene event " + std::to_string(k), {{"event", static_cast<std::int64_t>(k)}});
        const proto::Status done = std::visit([this](const auto& action) { return act(action); }, event.action);
        if (!done)
            report("scene_event.failed",
                   "scene event " + std::to_string(k) + ": " + done.error().message + "; " + done.error().hint,
                   {{"event", static_cast<std::int64_t>(k)}, {"error", std::string(done.error().name())}});
    }
    if (!has_acted_on_rest) return;
    // What the event did may end the rest (it removes the panel): a run until at rest goes on to the next one.
    is_at_rest = false;
    at_rest.emplace(*run);
}

proto::StateHash Simulation::Impl::refresh_hash() {
    return status.set_hash(solver::compute_state_hash(run->particles()), run->step_number());
}

Simulation::Simulation(const SimulationOptions& options, Outbox& outbox, EventLog& events, JobBoard& jobs,
                       StatusBoard& board, ProbeBoard& probe_board, publish::FrameHub& hub)
    : impl_(std::make_unique<Impl>(options, outbox, events, jobs, board, probe_board, hub)) {}

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
