// The generated files of proto/schemas: name -> text. The writer of the files and the test of their freshness share it.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "proto/messages_json.h"
#include "proto/methods.h"
#include "proto/presets.h"

namespace headrace::test {

inline std::filesystem::path schema_folder() {
    return std::filesystem::path(HEADRACE_SOURCE_DIR) / "proto" / "schemas";
}

inline std::map<std::string, std::string> schema_files() {
    std::map<std::string, std::string> files;
    const auto add = [&](const std::string& name, const proto::Json& schema) {
        files[name + ".schema.json"] = schema.dump(2) + "\n";
    };
    add("scene", proto::json_schema<proto::SceneDesc>());
    add("event", proto::json_schema<proto::Event>());
    add("error", proto::error_schema());
    for (const proto::MethodInfo& method : proto::kMethods) {
        const std::string name(method.name);
        add(name + ".params", proto::method_params_schema(name));
        add(name + ".result", proto::method_result_schema(name));
    }
    for (const proto::Preset& preset : proto::presets())
        if (preset.name == "dam_break") files["scene.example.json"] = preset.json;
    return files;
}

}  // namespace headrace::test
