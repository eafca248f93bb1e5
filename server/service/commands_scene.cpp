// scene.load, scene.get, scene.list, objects.*
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "proto/envelope.h"
#include "proto/presets.h"
#include "proto/suggest.h"
#include "server/scene/run.h"
#include "server/service/commands.h"
#include "server/service/post_mutation.h"

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;
using proto::Result;

namespace {

// A query that needs a scene and comes before the first one is built.
Error no_scene_yet() {
    return {ErrorCode::busy, "the scene is still being loaded", "method", "ask again when it is loaded"};
}

Result<proto::SceneDesc> find_preset(const std::string& name) {
    std::vector<std::string> names;
    for (const proto::Preset& preset : proto::presets()) {
        if (preset.name == name) return proto::parse_scene(preset.json);
        names.emplace_back(preset.name);
    }
    return Error{ErrorCode::scene_not_found, "there is no scene \"" + name + "\"", "params.scene",
                 proto::suggest(name, names)};
}

// The scene that is meant, with the overrides in it.
Result<proto::SceneDesc> resolve_scene(const proto::SceneLoad& params) {
    Result<proto::SceneDesc> scene = std::holds_alternative<std::string>(params.scene)
                                         ? find_preset(std::get<std::string>(params.scene))
                                         : std::get<proto::SceneDesc>(params.scene);
    if (!scene) return scene;
    for (const auto& [name, value] : params.parameters) scene->parameters[name] = value;
    return scene;
}

Result<proto::SceneListReply> list_scenes() {
    proto::SceneListReply reply;
    for (const proto::Preset& preset : proto::presets()) {
        const Result<proto::SceneDesc> scene = proto::parse_scene(preset.json);
        if (!scene) return scene.error();
        reply.scenes.push_back(
            {std::string(preset.name), scene->description, scene->dimensions, scene::count_particles(*scene)});
    }
    return reply;
}

}  // namespace

void add_scene_commands(CommandTable& table, CommandContext& context) {
    table.add<proto::SceneLoad>(
        "scene.load",
        {{ErrorCode::scene_not_found, ErrorCode::scene_invalid, ErrorCode::parameter_not_found, ErrorCode::file_error,
          ErrorCode::limit_exceeded, ErrorCode::wrong_state, ErrorCode::busy, ErrorCode::cancelled}},
        [&context](proto::SceneLoad params, Responder& responder) {
            Result<proto::SceneDesc> scene = resolve_scene(params);
            if (!scene) return responder.fail(scene.error());
            post_mutation(context, proto::SceneLoad{std::move(*scene), {}}, responder);
        });
    table.add_query<proto::SceneGet, proto::SceneDesc>("scene.get", {{ErrorCode::wrong_state, ErrorCode::busy}},
                                                       [&context](const proto::SceneGet&) -> Result<proto::SceneDesc> {
                                                           const auto snapshot = context.board.read();
                                                           if (!snapshot->scene) return no_scene_yet();
                                                           return *snapshot->scene;
                                                       });
    table.add_query<proto::SceneList, proto::SceneListReply>("scene.list", {},
                                                             [](const proto::SceneList&) { return list_scenes(); });

    table.add_query<proto::ObjectsList, proto::ObjectsListReply>(
        "objects.list", {{ErrorCode::wrong_state, ErrorCode::busy}},
        [&context](const proto::ObjectsList&) -> Result<proto::ObjectsListReply> {
            const auto snapshot = context.board.read();
            if (!snapshot->objects) return no_scene_yet();
            return proto::ObjectsListReply{*snapshot->objects};
        });
    table.add<proto::ObjectsAdd>("objects.add",
                                 {{ErrorCode::object_exists, ErrorCode::scene_invalid, ErrorCode::limit_exceeded,
                                   ErrorCode::wrong_state, ErrorCode::busy}},
                                 [&context](proto::ObjectsAdd params, Responder& responder) {
                                     post_mutation(context, std::move(params), responder);
                                 });
    table.add<proto::ObjectsMove>(
        "objects.move",
        {{ErrorCode::object_not_found, ErrorCode::limit_exceeded, ErrorCode::wrong_state, ErrorCode::busy}},
        [&context](proto::ObjectsMove params, Responder& responder) {
            post_mutation(context, std::move(params), responder);
        });
    table.add<proto::ObjectsRemove>(
        "objects.remove",
        {{ErrorCode::object_not_found, ErrorCode::limit_exceeded, ErrorCode::wrong_state, ErrorCode::busy}},
        [&context](proto::ObjectsRemove params, Responder& responder) {
            post_mutation(context, std::move(params), responder);
        });
}

}  // namespace headrace::server
