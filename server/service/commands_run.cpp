// sim.*, params.*, server.shutdown
#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "proto/envelope.h"
#include "proto/suggest.h"
#include "server/service/commands.h"
#include "server/service/limits.h"
#include "server/service/post_mutation.h"

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;
using proto::Result;

namespace {

Result<proto::ParamsGetReply> get_parameters(const CommandContext& context, const proto::ParamsGet& params) {
    const auto snapshot = context.board.read();
    if (!snapshot->parameters)
        return Error{ErrorCode::busy, "the scene is still being loaded", "method", "ask again when it is loaded"};
    const std::vector<proto::ParameterEntry>& table = *snapshot->parameters;
    if (params.names.empty()) return proto::ParamsGetReply{table};

    proto::ParamsGetReply reply;
    for (std::size_t k = 0; k < params.names.size(); ++k) {
        const auto entry = std::find_if(table.begin(), table.end(),
                                        [&](const proto::ParameterEntry& e) { return e.name == params.names[k]; });
        if (entry != table.end()) {
            reply.parameters.push_back(*entry);
            continue;
        }
        std::vector<std::string> known;
        for (const proto::ParameterEntry& e : table) known.push_back(e.name);
        return Error{ErrorCode::parameter_not_found, "the model has no parameter \"" + params.names[k] + "\"",
                     "params.names[" + std::to_string(k) + "]", proto::suggest(params.names[k], known)};
    }
    return reply;
}

void shut_down(CommandContext& context, Responder& responder) {
    const auto snapshot = context.board.read();
    responder.reply(proto::to_json(proto::Applied{snapshot->status.step, snapshot->status.time}));
    context.shut_down();
}

// A command that is nothing but a mutation.
template <class Params>
void add_mutation(CommandTable& table, CommandContext& context, std::string_view name, MethodRules rules) {
    table.add<Params>(name, std::move(rules), [&context](Params params, Responder& responder) {
        post_mutation(context, std::move(params), responder);
    });
}

// sim.pause and sim.cancel take effect at the end of the step under way. With millions of particles that is a while
// off: then the answer does not wait for it, and says so.
PendingReplies::Early answer_before_the_step_ends(const CommandContext& context) {
    return {std::chrono::steady_clock::now() + kPromptAnswer, [&context](Responder& waiting) {
                const proto::SimStatusReply status = context.board.read()->status;
                const bool is_stepping = status.state == proto::SimState::running;
                waiting.reply(proto::to_json(proto::Applied{
                    status.step + (is_stepping ? 1 : 0), status.time + (is_stepping ? status.time_step : 0.0), true}));
            }};
}

// A command that ends or holds what is under way.
template <class Params>
void add_prompt_mutation(CommandTable& table, CommandContext& context, std::string_view name, MethodRules rules) {
    table.add<Params>(name, std::move(rules), [&context](Params params, Responder& responder) {
        post_mutation(context, std::move(params), responder, answer_before_the_step_ends(context));
    });
}

}  // namespace

void add_run_commands(CommandTable& table, CommandContext& context) {
    add_mutation<proto::SimStep>(
        table, context, "sim.step",
        {{ErrorCode::limit_exceeded, ErrorCode::wrong_state, ErrorCode::busy, ErrorCode::cancelled}});
    add_mutation<proto::SimRun>(table, context, "sim.run",
                                {{ErrorCode::probe_not_found, ErrorCode::limit_exceeded, ErrorCode::wrong_state,
                                  ErrorCode::busy, ErrorCode::cancelled}});
    add_prompt_mutation<proto::SimPause>(table, context, "sim.pause",
                                         {{ErrorCode::limit_exceeded, ErrorCode::wrong_state, ErrorCode::busy}});
    add_mutation<proto::SimResume>(table, context, "sim.resume",
                                   {{ErrorCode::limit_exceeded, ErrorCode::wrong_state, ErrorCode::busy}});
    add_prompt_mutation<proto::SimCancel>(table, context, "sim.cancel", {{ErrorCode::limit_exceeded}});
    add_mutation<proto::SimReset>(table, context, "sim.reset",
                                  {{ErrorCode::scene_invalid, ErrorCode::file_error, ErrorCode::limit_exceeded,
                                    ErrorCode::wrong_state, ErrorCode::busy, ErrorCode::cancelled}});

    table.add_query<proto::ParamsGet, proto::ParamsGetReply>(
        "params.get", {{ErrorCode::parameter_not_found, ErrorCode::wrong_state, ErrorCode::busy}},
        [&context](const proto::ParamsGet& params) { return get_parameters(context, params); });
    add_mutation<proto::ParamsSet>(table, context, "params.set",
                                   {{ErrorCode::parameter_not_found, ErrorCode::limit_exceeded, ErrorCode::wrong_state,
                                     ErrorCode::busy, ErrorCode::cancelled}});
    table.add<proto::ServerShutdown>("server.shutdown", {}, [&context](proto::ServerShutdown, Responder& responder) {
        shut_down(context, responder);
    });
}

}  // namespace headrace::server
