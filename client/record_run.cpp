#include "client/record_run.h"

#include <chrono>

#include "client/call.h"
#include "client/interrupt.h"
#include "client/jobs.h"
#include "client/progress.h"

namespace headrace::client {

namespace {

using namespace std::chrono_literals;

constexpr auto kSlice = 50ms;         // of receiving, between two looks at the run
constexpr double kLookPeriod = 0.25;  // [s] between two looks when there is nothing to receive

// One round: frames, events, the stream's health.
proto::Status receive_slice(Recorder& recorder, bool is_running) {
    if (auto received = recorder.receive(kSlice); !received) return received;
    if (auto events = recorder.take_events(); !events) return events;
    return is_running ? recorder.reattach_when_silent() : proto::Done{};
}

// Sleeps until something happens at the server, at most for a look's period.
proto::Status wait_for_news(Connection& connection, std::uint64_t& last_event) {
    proto::EventsSince query;
    query.seq = last_event;
    query.timeout = kLookPeriod;
    query.types = {"job.started", "job.ended"};
    auto news = call<proto::EventsSinceReply>(connection, "events.since", query);
    if (!news) return news.error();
    last_event = news->last_seq;
    return proto::Done{};
}

}  // namespace

proto::Result<proto::JobReply> follow_job(Connection& connection, Recorder* recorder, const proto::JobReply& start,
                                          const proto::RunUntil& until, const std::string& label) {
    JobWatch watch(connection, start, until, label);
    proto::JobReply job = start;
    while (!has_ended(job.state) && !is_interrupted()) {
        proto::Status received{proto::Done{}};
        if (recorder != nullptr) received = receive_slice(*recorder, job.state == proto::JobState::running);
        auto now = received ? watch.look(recorder != nullptr ? 0.0 : kLookPeriod)
                            : proto::Result<proto::JobReply>(received.error());
        if (now)
            job = *now;
        else if (!is_interrupted())
            return now.error();
    }
    return job;
}

proto::Result<proto::JobReply> follow_others(Connection& connection, Recorder* recorder,
                                             const proto::SimStatusReply& before, std::optional<double> for_seconds,
                                             const std::string& label) {
    Progress progress = make_progress(label);
    const std::uint64_t seen_job = before.job && has_ended(before.job->state) ? before.job->job : 0;
    const double begin = recorder != nullptr ? recorder->first_time() : before.time;
    if (for_seconds && recorder != nullptr) recorder->set_last_time(begin + *for_seconds);
    proto::JobReply job;
    bool is_running = false;
    std::uint64_t last_event = 0;
    while (!is_interrupted()) {
        auto waited =
            recorder != nullptr ? receive_slice(*recorder, is_running) : wait_for_news(connection, last_event);
        auto status = waited ? call<proto::SimStatusReply>(connection, "sim.status", proto::SimStatus{})
                             : proto::Result<proto::SimStatusReply>(waited.error());
        if (!status && is_interrupted()) break;
        if (!status) return status.error();
        is_running = status->state == proto::SimState::running;
        if (status->job && status->job->job > seen_job) job = *status->job;
        if (job.job != 0 && has_ended(job.state)) break;

        const double time = recorder != nullptr ? recorder->last_time().value_or(begin) : status->time;
        std::optional<double> fraction;
        if (for_seconds) fraction = (time - begin) / *for_seconds;
        if (fraction && *fraction >= 1.0 - 1e-9) break;  // times are sums of rounded time steps
        progress.update(fraction, run_detail(*status));
    }
    return job;
}

proto::Status end_recording(Recorder& recorder, const proto::Status& outcome) {
    if (!outcome && outcome.error().code == proto::ErrorCode::connection_failed) {
        (void)recorder.abandon();  // the lost connection is the news
        return outcome;
    }
    auto closed = recorder.close();
    return outcome ? closed : outcome;
}

}  // namespace headrace::client
