// probes.*, sim.inspect
#include <utility>
#include <variant>

#include "proto/envelope.h"
#include "server/service/commands.h"
#include "server/service/post_mutation.h"

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;
using proto::Result;

namespace {

bool has_scene(const CommandContext& context) {
    return context.board.read()->scene != nullptr;
}

Error no_scene_yet() {
    return {ErrorCode::busy, "the scene is still being loaded", "method", "ask again when it is loaded"};
}

// A question to the simulation thread: nothing changes, so recordings keep nothing of it.
void inspect(CommandContext& context, const proto::SimInspect& params, Responder& responder) {
    const auto finish = [](const Result<proto::Reply>& result, Responder& waiting) {
        if (!result) return waiting.fail(result.error());
        waiting.reply(std::visit([](const auto& value) { return proto::to_json(value); }, *result));
    };
    if (const auto token = context.pending.add(responder, finish)) context.to_simulation(*token, params);
}

}  // namespace

void add_probe_commands(CommandTable& table, CommandContext& context) {
    table.add_query<proto::ProbesList, proto::ProbesListReply>(
        "probes.list", {{ErrorCode::wrong_state, ErrorCode::busy}},
        [&context](const proto::ProbesList&) -> Result<proto::ProbesListReply> {
            if (!has_scene(context)) return no_scene_yet();
            return context.probes.list();
        });
    table.add_query<proto::ProbesGet, proto::ProbesGetReply>(
        "probes.get", {{ErrorCode::probe_not_found, ErrorCode::wrong_state, ErrorCode::busy}},
        [&context](const proto::ProbesGet& params) -> Result<proto::ProbesGetReply> {
            if (!has_scene(context)) return no_scene_yet();
            return context.probes.get(params);
        });
    table.add<proto::ProbesAdd>("probes.add",
                                {{ErrorCode::probe_exists, ErrorCode::object_not_found, ErrorCode::limit_exceeded,
                                  ErrorCode::wrong_state, ErrorCode::busy}},
                                [&context](proto::ProbesAdd params, Responder& responder) {
                                    post_mutation(context, std::move(params), responder);
                                });
    table.add<proto::ProbesRemove>(
        "probes.remove",
        {{ErrorCode::probe_not_found, ErrorCode::limit_exceeded, ErrorCode::wrong_state, ErrorCode::busy}},
        [&context](proto::ProbesRemove params, Responder& responder) {
            post_mutation(context, std::move(params), responder);
        });
    table.add<proto::SimInspect>(
        "sim.inspect",
        {{ErrorCode::particle_not_found, ErrorCode::limit_exceeded, ErrorCode::wrong_state, ErrorCode::busy}},
        [&context](const proto::SimInspect& params, Responder& responder) { inspect(context, params, responder); });
}

}  // namespace headrace::server
