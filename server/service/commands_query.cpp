// hello, describe, sim.status, events.since, job.wait: answered without asking the simulation's step queue.
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "proto/envelope.h"
#include "server/service/commands.h"

namespace headrace::server {

using proto::ErrorCode;
using Clock = std::chrono::steady_clock;

namespace {

Clock::time_point after(double seconds) {
    const std::chrono::duration<double> wait(std::min(seconds, 1e8));  // three years: the clock would overflow
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(wait);
}

proto::SimStatusReply present_status(const CommandContext& context) {
    proto::SimStatusReply status = context.board.read()->status;
    publish::tell_counts(context.publisher_counts(), status);
    status.uptime_s = std::chrono::duration<double>(Clock::now() - context.started).count();
    return status;
}

void answer_status(CommandContext& context, const proto::SimStatus& params, Responder& responder) {
    if (!params.hash) return responder.reply(proto::to_json(present_status(context)));
    const auto finish = [&context](const proto::Result<proto::Reply>& result, Responder& waiting) {
        if (!result) return waiting.fail(result.error());
        proto::SimStatusReply status = present_status(context);
        if (const auto* hash = std::get_if<proto::StateHash>(&*result)) status.state_hash = *hash;
        waiting.reply(proto::to_json(status));
    };
    if (const auto token = context.pending.add(responder, finish)) context.to_simulation(*token, HashWanted{});
}

void answer_events(CommandContext& context, const proto::EventsSince& params, Responder& responder) {
    // Each look begins where the last one ended: a long memory is not searched again at each event.
    context.waiters.add(responder, after(params.timeout),
                        [&context, query = params, lost = std::uint64_t{0}](Responder& waiting, bool is_late) mutable {
                            proto::EventsSinceReply reply = context.events.since(query);
                            lost += std::exchange(reply.lost, 0);
                            query.seq = reply.last_seq;
                            if (reply.events.empty() && !is_late && query.timeout > 0.0) return;
                            reply.lost = lost;
                            waiting.reply(proto::to_json(reply));
                        });
}

void answer_job(CommandContext& context, const proto::JobWait& params, Responder& responder) {
    std::optional<Clock::time_point> deadline;
    if (params.timeout) deadline = after(*params.timeout);
    const bool is_late_at_once = params.timeout && *params.timeout <= 0.0;
    context.waiters.add(responder, deadline, [&context, params, is_late_at_once](Responder& waiting, bool is_late) {
        const auto job = context.jobs.find(params.job);
        if (!job) {
            waiting.fail({ErrorCode::job_not_found, "there is no job " + std::to_string(params.job), "params.job",
                          "sim.status tells the last job; the server remembers the last " +
                              std::to_string(JobBoard::kCapacity)});
        } else if (job->state != proto::JobState::running && job->state != proto::JobState::paused) {
            waiting.reply(proto::to_json(*job));
        } else if (is_late || is_late_at_once) {
            waiting.fail({ErrorCode::timed_out, "job " + std::to_string(params.job) + " has not ended yet",
                          "params.timeout", "wait again; the job goes on"});
        }
    });
}

}  // namespace

void add_query_commands(CommandTable& table, CommandContext& context) {
    table.add_query<proto::Hello, proto::HelloReply>(
        "hello", {}, [&context](const proto::Hello&) -> proto::Result<proto::HelloReply> { return context.hello; });
    // Built once, when it is first asked for: the table does not change.
    table.add<proto::Describe>(
        "describe", {},
        [&table, document = std::make_shared<proto::Json>()](const proto::Describe&, Responder& responder) {
            if (document->is_null()) *document = make_description(table);
            responder.reply(*document);
        });
    table.add<proto::SimStatus>("sim.status", {{ErrorCode::limit_exceeded, ErrorCode::wrong_state}},
                                [&context](const proto::SimStatus& params, Responder& responder) {
                                    answer_status(context, params, responder);
                                });
    table.add<proto::JobWait>(
        "job.wait", {{ErrorCode::job_not_found, ErrorCode::limit_exceeded, ErrorCode::timed_out}},
        [&context](const proto::JobWait& params, Responder& responder) { answer_job(context, params, responder); });
    table.add<proto::EventsSince>("events.since", {{ErrorCode::limit_exceeded}},
                                  [&context](const proto::EventsSince& params, Responder& responder) {
                                      answer_events(context, params, responder);
                                  });
}

void add_commands(CommandTable& table, CommandContext& context) {
    add_query_commands(table, context);
    add_scene_commands(table, context);
    add_run_commands(table, context);
    add_probe_commands(table, context);
    add_stream_commands(table, context);
}

}  // namespace headrace::server
