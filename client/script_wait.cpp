#include "client/script_wait.h"

#include <algorithm>
#include <chrono>

#include "client/call.h"
#include "client/jobs.h"
#include "client/text.h"

namespace headrace::client {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLookPeriod = 0.05;  // [s] between looks at a run that goes on
constexpr double kLongPoll = 1.0;     // [s] well below the patience for a query

}  // namespace

proto::Status ScriptWaits::begin() {
    for (;;) {
        auto past = call<proto::EventsSinceReply>(connection_, "events.since", proto::EventsSince{.seq = seen_});
        if (!past) return past.error();
        seen_ = past->last_seq;
        if (past->events.empty()) return proto::Done{};
    }
}

proto::Status ScriptWaits::wait(const proto::RunUntil& until, const std::string& label) {
    auto status = call<proto::SimStatusReply>(connection_, "sim.status", proto::SimStatus{});
    if (!status) return status.error();
    if (status->state == proto::SimState::running && status->job) return watch(*status->job, until);
    auto job = start_run(connection_, until);
    if (job) job = JobWatch(connection_, *job, until, label).wait();
    if (!job) return job.error();
    return job_verdict(connection_, *job);
}

proto::Status ScriptWaits::watch(const proto::JobReply& job, const proto::RunUntil& until) {
    auto start = call<proto::SimStatusReply>(connection_, "sim.status", proto::SimStatus{});
    if (!start) return start.error();
    for (;;) {
        // The job is looked at before the moment: what ends it may be the moment itself.
        auto now = look_at_job(connection_, job.job, kLookPeriod);
        if (!now) return now.error();
        auto there = is_there(*start, until);
        if (!there) return there.error();
        if (*there) return proto::Done{};
        if (until.timeout && now->time >= start->time + *until.timeout)
            return proto::Error{proto::ErrorCode::timed_out, "not there at " + at_moment(now->step, now->time), "", ""};
        if (now->state == proto::JobState::running) continue;
        if (auto verdict = job_verdict(connection_, *now); !verdict) return verdict;
        return proto::Error{proto::ErrorCode::wrong_state,
                            "the run that was under way has ended before: " + job_line(*now, {}), "",
                            "without a run under way the wait starts one that ends there"};
    }
}

proto::Result<bool> ScriptWaits::is_there(const proto::SimStatusReply& start, const proto::RunUntil& until) {
    if (until.at_rest) return take_event("sim.at_rest", 0.0);
    if (until.probe) return has_value(*until.probe);
    auto status = call<proto::SimStatusReply>(connection_, "sim.status", proto::SimStatus{});
    if (!status) return status.error();
    const auto step = static_cast<std::int64_t>(status->step), first = static_cast<std::int64_t>(start.step);
    if (until.time) return status->time >= *until.time;
    if (until.duration) return status->time >= start.time + *until.duration;
    if (until.step) return step >= *until.step;
    return step >= first + until.steps.value_or(0);
}

proto::Result<bool> ScriptWaits::has_value(const proto::ProbeConditionDesc& condition) {
    auto list = call<proto::ProbesListReply>(connection_, "probes.list", proto::ProbesList{});
    if (!list) return list.error();
    for (const proto::ProbeState& state : list->probes)
        for (std::size_t column = 1; column < state.columns.size() && column < state.latest.size(); ++column) {
            const std::string& name = state.probe.name;
            if (condition.probe != name && condition.probe != name + "." + state.columns[column].name) continue;
            const std::optional<double>& value = state.latest[column];
            return value && (condition.above ? *value > *condition.above : *value < condition.below.value_or(0.0));
        }
    return proto::Error{proto::ErrorCode::probe_not_found, "no probe \"" + condition.probe + "\"", "wait",
                        "headrace probes lists them"};
}

proto::Result<bool> ScriptWaits::take_event(const std::string& type, double patience) {
    proto::EventsSince query{.seq = seen_, .timeout = patience, .types = {type}, .limit = 1};
    auto reply = call<proto::EventsSinceReply>(connection_, "events.since", query);
    if (!reply) return reply.error();
    if (reply->events.empty()) return false;
    seen_ = reply->events.front().seq;  // not last_seq: what came behind it, of other types, is for the waits to come
    return true;
}

proto::Status ScriptWaits::wait(const ScriptEvent& event) {
    const auto begun = Clock::now();
    for (;;) {
        double patience = kLongPoll;
        if (event.timeout)
            patience = std::clamp(*event.timeout - std::chrono::duration<double>(Clock::now() - begun).count(), 0.0,
                                  kLongPoll);
        auto came = take_event(event.type, patience);
        if (!came) return came.error();
        if (*came) return proto::Done{};
        if (event.timeout && patience <= 0.0)
            return proto::Error{proto::ErrorCode::timed_out,
                                "no event " + event.type + " within " + number(*event.timeout) + " s", "wait.timeout",
                                ""};
    }
}

}  // namespace headrace::client
