#include "tests/bench/cases.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "proto/messages_json.h"
#include "proto/presets.h"
#include "server/solver/models/registry.h"

namespace headrace::bench {

namespace {

proto::Result<proto::SceneDesc> find_preset(const std::string& name) {
    std::string known;
    for (const proto::Preset& preset : proto::presets()) {
        if (preset.name == name) return proto::parse_scene(preset.json);
        known += " " + std::string(preset.name);
    }
    proto::Error error;
    error.code = proto::ErrorCode::scene_not_found;
    error.message = "no preset '" + name + "'; there are:" + known;
    return error;
}

// Names of the parameters whose default differs between the two spacings.
std::vector<std::string> find_scale_parameters(const proto::SceneDesc& scene, double spacing) {
    const auto coarse = solver::model_parameter_table(scene.model, scene.dimensions, scene.spacing);
    const auto fine = solver::model_parameter_table(scene.model, scene.dimensions, spacing);
    std::vector<std::string> names;
    for (const solver::ParameterInfo& info : coarse) {
        const auto same = std::find_if(fine.begin(), fine.end(), [&](const auto& other) {
            return other.name == info.name && other.default_value == info.default_value;
        });
        if (same == fine.end()) names.push_back(info.name);
    }
    return names;
}

}  // namespace

proto::Result<Case> make_case(const std::string& preset, double refine, const std::vector<std::string>& removed) {
    auto scene = find_preset(preset);
    if (!scene) return scene.error();

    Case made{preset, std::move(*scene)};
    if (refine != 1.0) {
        const double spacing = made.scene.spacing / refine;
        for (const std::string& name : find_scale_parameters(made.scene, spacing)) made.scene.parameters.erase(name);
        made.scene.spacing = spacing;
        char suffix[32];
        std::snprintf(suffix, sizeof suffix, "/%g", refine);
        made.label += suffix;
    }
    std::erase_if(made.scene.objects, [&](const proto::ObjectDesc& object) {
        return std::find(removed.begin(), removed.end(), object.name) != removed.end();
    });
    // The scene's own events could change the run while it is timed, or name a removed object.
    made.scene.events.clear();
    return made;
}

}  // namespace headrace::bench
