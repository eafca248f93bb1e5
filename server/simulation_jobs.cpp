// Runs: started, paused, resumed, ended.
#include "server/simulation_impl.h"

namespace headrace::server {

void Simulation::Impl::apply(Token token, proto::SimStep request) {
    if (!is_allowed(token, "sim.step")) return;
    proto::RunUntil until;
    until.steps = request.steps;
    start_job(token, until, std::nullopt, true);
}

void Simulation::Impl::apply(Token token, proto::SimRun request) {
    if (!is_allowed(token, "sim.run")) return;
    if (paused) {
        outbox.put(token, Error{ErrorCode::wrong_state, "job " + std::to_string(paused->number) + " is paused", "",
                                "sim.resume continues it, sim.cancel ends it"});
        return;
    }
    if (request.until.probe)
        if (const auto known = probes.probes().check(*request.until.probe, "params.until.probe"); !known) {
            outbox.put(token, known.error());
            return;
        }
    start_job(token, request.until, request.pace, request.wait);
}

void Simulation::Impl::start_job(Token token, const proto::RunUntil& until, std::optional<double> pace, bool wait) {
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

void Simulation::Impl::announce(const char* type, std::string message) {
    const auto reply = job->reply(proto::JobState::running, "", place());
    jobs.write(reply);
    write_status();
    report(type, std::move(message), {{"job", static_cast<std::int64_t>(reply.job)}});
}

void Simulation::Impl::apply(Token token, proto::SimPause) {
    if (!is_allowed(token, "sim.pause")) return;
    pause_job();
    answer(token, applied());
}

void Simulation::Impl::pause_job() {
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

void Simulation::Impl::apply(Token token, proto::SimResume) {
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

void Simulation::Impl::apply(Token token, proto::SimCancel) {
    if (loader.is_loading()) {
        loader.cancel();
        load_cancels.push_back(token);  // answered when the worker has stopped
        return;
    }
    end_all_jobs({proto::JobState::cancelled, "cancelled"});
    answer(token, applied());
}

bool Simulation::Impl::end_job_if_done() {
    if (!job) return false;
    const auto probe_holds = job->until_probe ? probes.probes().holds(*job->until_probe) : std::nullopt;
    const auto end = job->end(place(), run->model().time_step(), is_at_rest, probe_holds);
    if (!end) return false;
    if (job->until_at_rest && end->state == proto::JobState::finished && is_at_rest)
        report("sim.at_rest", "the fluid is at rest", {{"job", static_cast<std::int64_t>(job->number)}});
    end_job(*std::exchange(job, std::nullopt), *end);
    return true;
}

void Simulation::Impl::end_job(Job ended, const Job::End& end) {
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

void Simulation::Impl::end_all_jobs(const Job::End& end) {
    if (job) end_job(*std::exchange(job, std::nullopt), end);
    if (paused) end_job(*std::exchange(paused, std::nullopt), end);
}

void Simulation::Impl::restart_rest_watch() {
    if (job->until_at_rest) at_rest.emplace(*run);
    is_at_rest = false;
}

}  // namespace headrace::server
