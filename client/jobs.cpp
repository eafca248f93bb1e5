#include "client/jobs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/call.h"
#include "client/text.h"

namespace headrace::client {

namespace {

constexpr double kLookPeriod = 0.25;  // [s] between looks at a job that is waited for

}  // namespace

std::optional<double> run_fraction(const proto::RunUntil& until, const proto::JobReply& start, std::uint64_t step,
                                   double time) {
    const auto share = [](double now, double begin, double end) {
        return end > begin ? std::clamp((now - begin) / (end - begin), 0.0, 1.0) : 1.0;
    };
    // JobReply's own counts may already have moved on when the reply was sent.
    const double start_step = static_cast<double>(start.step) - static_cast<double>(start.steps);
    if (until.time) return share(time, start.time, *until.time);
    if (until.duration) return share(time, start.time, start.time + *until.duration);
    if (until.step) return share(static_cast<double>(step), start_step, static_cast<double>(*until.step));
    if (until.steps)
        return share(static_cast<double>(step), start_step, start_step + static_cast<double>(*until.steps));
    return std::nullopt;
}

std::string run_detail(const proto::SimStatusReply& status) {
    std::string text =
        "t " + number(status.time) + " s, step " + with_thousands(static_cast<std::int64_t>(status.step));
    if (status.job && status.job->state == proto::JobState::paused) return text + ", paused";
    if (status.stalled) return text + ", waiting for a reader";
    const double rate = status.steps_per_second;
    if (rate >= 10)
        text += ", " + with_thousands(static_cast<std::int64_t>(rate)) + " steps/s";
    else if (rate > 0)
        text += ", " + number(std::round(rate * 10) / 10) + " steps/s";
    return text;
}

proto::Result<proto::JobReply> start_run(Connection& connection, const proto::RunUntil& until,
                                         std::optional<double> pace) {
    proto::SimRun run;
    run.until = until;
    run.pace = pace;
    return call<proto::JobReply>(connection, "sim.run", run, Patience::while_alive);
}

proto::Result<proto::JobReply> look_at_job(Connection& connection, std::uint64_t job, double patience) {
    auto ended = call<proto::JobReply>(connection, "job.wait", proto::JobWait{job, patience});
    if (ended || ended.error().code != proto::ErrorCode::timed_out) return ended;
    auto status = call<proto::SimStatusReply>(connection, "sim.status", proto::SimStatus{});
    if (!status) return status.error();
    if (status->job && status->job->job == job) return *status->job;
    // It ended between the two questions, and another one has begun.
    return call<proto::JobReply>(connection, "job.wait", proto::JobWait{job, patience});
}

bool has_ended(proto::JobState state) {
    return state != proto::JobState::running && state != proto::JobState::paused;
}

JobWatch::JobWatch(Connection& connection, proto::JobReply start, proto::RunUntil until, std::string label)
    : connection_(connection),
      start_(std::move(start)),
      until_(std::move(until)),
      progress_(make_progress(std::move(label))) {}

proto::Result<proto::JobReply> JobWatch::look(double patience) {
    auto job = look_at_job(connection_, start_.job, patience);
    if (!job || has_ended(job->state)) {
        progress_.finish();
        return job;
    }
    auto status = call<proto::SimStatusReply>(connection_, "sim.status", proto::SimStatus{});
    if (!status) return status.error();
    progress_.update(run_fraction(until_, start_, status->step, status->time), run_detail(*status));
    return job;
}

proto::Result<proto::JobReply> JobWatch::wait() {
    for (;;) {
        auto job = look(kLookPeriod);
        if (!job || job->state != proto::JobState::running) {
            progress_.finish();
            return job;
        }
    }
}

std::string job_line(const proto::JobReply& job, const proto::RunUntil& until) {
    std::string word = job_state_text(job.state);
    if (job.state == proto::JobState::finished)
        word = until.at_rest.value_or(false) ? "at rest" : until.probe ? job.reason : "done";
    return word + ": " + at_moment(job.step, job.time);
}

proto::Error fault_error(const proto::FaultReport& fault) {
    const auto vector = [](const proto::Vec3& v) {
        return "(" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + ")";
    };
    return {proto::ErrorCode::faulted,
            fault.criterion + ": particle " + with_thousands(fault.particle) + " at " + vector(fault.position) +
                " m with " + vector(fault.velocity) + " m/s, " + at_moment(fault.step, fault.time),
            "", fault.remedy};
}

proto::Status job_verdict(Connection& connection, const proto::JobReply& job, const std::string& timed_out_hint) {
    switch (job.state) {
        case proto::JobState::running:
        case proto::JobState::paused:
        case proto::JobState::finished:
            return proto::Done{};
        case proto::JobState::timed_out:
            return proto::Error{
                proto::ErrorCode::timed_out,
                (job.reason.empty() ? "the run timed out" : job.reason) + " (" + at_moment(job.step, job.time) + ")",
                "", timed_out_hint};
        case proto::JobState::cancelled:
            return proto::Error{proto::ErrorCode::cancelled,
                                "the run was cancelled at " + at_moment(job.step, job.time), "", ""};
        case proto::JobState::faulted:
            break;
    }
    auto status = call<proto::SimStatusReply>(connection, "sim.status", proto::SimStatus{});
    if (status && status->fault) return fault_error(*status->fault);
    return proto::Error{proto::ErrorCode::faulted, job.reason, "", "headrace reset loads the scene anew"};
}

}  // namespace headrace::client
