#include "client/scene_request.h"

#include <filesystem>

#include "client/arguments.h"
#include "client/json_words.h"
#include "client/text.h"

namespace headrace::client {

namespace {

bool is_document(const std::string& scene) {
    std::error_code ignored;
    return scene.ends_with(".json") || std::filesystem::is_regular_file(scene, ignored);
}

}  // namespace

std::filesystem::path scene_folder(const std::string& scene) {
    if (!is_document(scene)) return {};
    const std::filesystem::path folder = std::filesystem::path(scene).parent_path();
    return folder.empty() ? "." : folder;
}

proto::Result<proto::Json> scene_load_params(const std::string& scene, const std::vector<std::string>& assignments) {
    auto parameters = parse_assignments(assignments);
    if (!parameters) return parameters.error();
    proto::Json params = proto::to_json(proto::SceneLoad{scene, *std::move(parameters)});
    if (is_document(scene)) {
        auto document = read_json_file(scene, "headrace scenes lists the scenes that need no file");
        if (!document) return document.error();
        params["scene"] = *std::move(document);
    }
    return params;
}

proto::Result<proto::SceneLoadReply> load_scene(Connection& connection, const proto::Json& params) {
    auto result = connection.request("scene.load", params, Patience::while_alive);
    if (!result) return result.error();
    return proto::from_json<proto::SceneLoadReply>(*result, "result");
}

std::string loaded_line(const proto::SceneLoadReply& reply) {
    std::string line = reply.scene + ": " + plural(reply.particles, "particle") + ", dt " + number(reply.time_step) +
                       " s, " + state_text(reply.state);
    for (std::size_t k = 0; k < reply.objects.size(); ++k) line += (k == 0 ? "; objects: " : ", ") + reply.objects[k];
    return line;
}

}  // namespace headrace::client
