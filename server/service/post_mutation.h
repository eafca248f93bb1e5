// Hands a mutation over to the simulation; for the .cpp files of the command families only.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "proto/envelope.h"
#include "server/service/commands.h"

namespace headrace::server {

// What recordings keep of an applied command: the request, and where in the run it was applied.
inline void record_applied(const CommandContext& context, const std::string& method, proto::Json params,
                           const proto::Json& reply) {
    const double time = reply.value("time", 0.0);  // [s]
    proto::Json command{{"method", method}, {"params", std::move(params)}};
    // A run is recorded when it has ended: its step is the one at which it began.
    command["step"] = reply.value("step", std::uint64_t{0}) - reply.value("steps", std::uint64_t{0});
    command["time"] = time;
    context.record_command(command.dump(-1, ' ', false, proto::Json::error_handler_t::replace), time);
}

template <class Params>
void post_mutation(CommandContext& context, Params params, Responder& responder,
                   std::optional<PendingReplies::Early> early = {}) {
    const auto finish = [&context, method = responder.method(), json = proto::to_json(params)](
                            const proto::Result<proto::Reply>& result, Responder& waiting) {
        if (!result) {
            if (waiting.is_open()) waiting.fail(result.error());
            return;
        }
        const proto::Json reply = std::visit([](const auto& value) { return proto::to_json(value); }, *result);
        record_applied(context, method, json, reply);
        if (waiting.is_open()) waiting.reply(reply);
    };
    if (const auto token = context.pending.add(responder, finish, std::move(early)))
        context.to_simulation(*token, Mutation(std::move(params)));
}

}  // namespace headrace::server
