#include "server/job.h"

#include <cmath>
#include <cstdio>

namespace headrace::server {

namespace {

std::string seconds(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g s", value);
    return text;
}

double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Job Job::make(std::uint64_t number, const proto::RunUntil& until, const Place& now, double at_rest_timeout) {
    Job job;
    job.number = number;
    job.first_step = now.step;
    if (until.step) job.until_step = static_cast<std::uint64_t>(*until.step);
    if (until.steps) job.until_step = now.step + static_cast<std::uint64_t>(*until.steps);
    job.until_time = until.time;
    if (until.duration) job.until_time = now.time + *until.duration;
    job.until_at_rest = until.at_rest.value_or(false);
    job.until_probe = until.probe;
    if (until.timeout)
        job.timeout_time = now.time + *until.timeout;
    else if (job.until_at_rest)
        job.timeout_time = now.time + at_rest_timeout;
    job.resume(now);
    return job;
}

void Job::restart_pace(const Place& now) {
    pace_wall = Clock::now();
    pace_time = now.time;
}

void Job::resume(const Place& now) {
    restart_pace(now);
    resumed_at = pace_wall;
    is_running = true;
}

void Job::pause() {
    if (is_running) wall_s += since(resumed_at);
    is_running = false;
}

std::optional<Clock::time_point> Job::next_step_at(const Place& now, double dt) const {
    if (!pace) return std::nullopt;
    constexpr double kLongest = 1e8;  // [s] keeps a tiny pace within the clock's range
    const std::chrono::duration<double> ahead(std::fmin((now.time + dt - pace_time) / *pace, kLongest));
    return pace_wall + std::chrono::duration_cast<Clock::duration>(ahead);
}

std::optional<Job::End> Job::end(const Place& now, double dt, bool is_at_rest,
                                 const std::optional<std::string>& probe_holds) const {
    using proto::JobState;
    const double slack = 1e-6 * dt;
    if (until_step && now.step >= *until_step)
        return End{JobState::finished, "step " + std::to_string(now.step) + " reached"};
    if (until_time && now.time >= *until_time - slack)
        return End{JobState::finished, "time " + seconds(now.time) + " reached"};
    if (until_at_rest && is_at_rest) return End{JobState::finished, "at rest"};
    if (until_probe && probe_holds) return End{JobState::finished, *probe_holds};
    if (timeout_time && now.time >= *timeout_time - slack)
        return End{JobState::timed_out, std::string(until_at_rest ? "not at rest" : "target not reached") +
                                            " within the time-out at " + seconds(*timeout_time)};
    return std::nullopt;
}

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

proto::JobReply Job::reply(proto::JobState state, const std::string& reason, const Place& now) const {
    proto::JobReply reply;
    reply.job = number;
    reply.state = state;
    reply.reason = reason;
    reply.step = now.step;
    reply.time = now.time;
    reply.steps = static_cast<std::int64_t>(now.step - first_step);
    reply.wall_s = wall_s + (is_running ? since(resumed_at) : 0.0);
    return reply;
}

}  // namespace headrace::server
