// The params of scene.load from what the user typed. Includes the JSON library: for .cpp files only.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/connection.h"
#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::client {

// `scene`: a preset's name, or a scene document: an existing file, or a name that ends in .json. `assignments`: of
// parameters, "name=value". Errors: usage, file_error, parse_error with the file's name.
proto::Result<proto::Json> scene_load_params(const std::string& scene, const std::vector<std::string>& assignments);

// The folder that a scene document lies in, where a private server finds the files it names; empty for presets.
std::filesystem::path scene_folder(const std::string& scene);

proto::Result<proto::SceneLoadReply> load_scene(Connection& connection, const proto::Json& params);

// "dam_break: 3,000 particles, dt 0.01 s, idle; objects: tank, panel"
std::string loaded_line(const proto::SceneLoadReply& reply);

}  // namespace headrace::client
