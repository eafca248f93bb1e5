#include "client/convergence_plan.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <variant>

#include "client/arguments.h"
#include "client/json_words.h"
#include "client/scene_request.h"
#include "proto/presets.h"
#include "proto/shape_bounds.h"
#include "proto/suggest.h"

namespace headrace::client {

namespace {

// Parameters that follow the spacing where a scene leaves them alone.
constexpr const char* kFollowers[] = {"support_radius", "surface_tension_threshold", "particle_mass", "time_step"};

constexpr double kWhole = 1e-3;   // [cells] a length of so nearly whole cells is meant to be filled
constexpr double kLeeway = 0.08;  // of a spacing, to fill lengths with whole cells

bool is_set(const proto::Parameters& parameters, const std::string& name) {
    const auto found = parameters.find(name);
    // 0 stands for the model's own choice where it is allowed at all.
    return found != parameters.end() && found->second != proto::ParameterValue{0.0};
}

proto::Result<std::string> preset_text(const std::string& name) {
    std::vector<std::string> known;
    for (const proto::Preset& preset : proto::presets()) {
        if (preset.name == name) return std::string(preset.json);
        known.emplace_back(preset.name);
    }
    return proto::Error{proto::ErrorCode::scene_not_found, "no scene \"" + name + "\"", "SCENE",
                        proto::suggest(name, known)};
}

// [m] Lengths that the lattice of this spacing fills with whole cells.
std::vector<double> whole_lengths(const proto::SceneDesc& scene, double spacing) {
    std::vector<double> lengths;
    const auto add = [&](double length) {
        const double cells = length / spacing;
        if (std::isfinite(cells) && cells > 0.5 && std::abs(cells - std::round(cells)) < kWhole)
            lengths.push_back(length);
    };
    for (int k = 0; k < scene.dimensions; ++k) {
        if (scene.domain.periodic[k]) add(scene.domain.max[k] - scene.domain.min[k]);
        for (const proto::FluidDesc& fluid : scene.fluids) {
            const proto::BoxDesc box = proto::bounding_box(fluid.shape);
            add(box.max[k] - box.min[k]);
        }
    }
    return lengths;
}

// [cells] How far the worst of the lengths is from whole cells.
double misfit(const std::vector<double>& lengths, double spacing) {
    double worst = 0;
    for (const double length : lengths)
        worst = std::max(worst, std::abs(length / spacing - std::round(length / spacing)));
    return worst;
}

double choose_spacing(const std::vector<double>& lengths, double target) {
    double best = target, best_misfit = misfit(lengths, target);
    const auto is_better = [&](double candidate, double candidate_misfit) {
        if (candidate_misfit < best_misfit - kWhole) return true;
        return candidate_misfit < best_misfit + kWhole &&
               std::abs(std::log(candidate / target)) < std::abs(std::log(best / target));
    };
    for (const double length : lengths) {
        const double most = std::floor(length / (target * (1 - kLeeway)));
        for (double cells = std::ceil(length / (target * (1 + kLeeway))); cells <= most; ++cells) {
            if (cells < 1) continue;
            const double candidate = length / cells, candidate_misfit = misfit(lengths, candidate);
            if (!is_better(candidate, candidate_misfit)) continue;
            best = candidate;
            best_misfit = candidate_misfit;
        }
    }
    return best;
}

const double* find_number(const std::vector<proto::ParameterEntry>& parameters, const std::string& name) {
    for (const proto::ParameterEntry& entry : parameters)
        if (entry.name == name) return std::get_if<double>(&entry.value);
    return nullptr;
}

}  // namespace

proto::Result<proto::SceneDesc> read_scene(const std::string& scene, const std::vector<std::string>& assignments) {
    auto params = scene_load_params(scene, assignments);
    if (!params) return params.error();
    const proto::Json& document = (*params)["scene"];
    std::string text = document.dump();
    if (document.is_string()) {
        auto preset = preset_text(scene);
        if (!preset) return preset.error();
        text = *preset;
    }
    auto parsed = proto::parse_scene(text);
    if (!parsed) {
        proto::Error error = parsed.error();
        error.path = scene + (error.path.empty() ? "" : ": " + error.path);
        return error;
    }
    auto parameters = parse_assignments(assignments);
    if (!parameters) return parameters.error();
    for (const auto& [name, value] : *parameters) parsed->parameters[name] = value;
    return parsed;
}

proto::Status add_probe(proto::SceneDesc& scene, const std::string& word) {
    auto added = parse_probe(word);
    if (!added) return added.error();
    for (const proto::ProbeDesc& probe : scene.probes)
        if (probe.name == added->name)
            return proto::Error{proto::ErrorCode::probe_exists, "there is a probe \"" + probe.name + "\" already",
                                "--probe", "choose another name"};
    scene.probes.push_back(*std::move(added));
    return proto::Done{};
}

proto::Status check_refinable(const proto::SceneDesc& scene) {
    if (scene.probes.empty())
        return usage_error("the scene has no probes: there is nothing to compare", "scene.probes",
                           R"(add one here: --probe 'gauge={"level": {"from": [0.1, 0], "to": [0.1, 0.5]}}')");
    std::string names;
    for (const char* name : kFollowers)
        if (is_set(scene.parameters, name)) names += (names.empty() ? "" : ", ") + std::string(name);
    if (!names.empty())
        return usage_error("fixed for one spacing: " + names, "scene.parameters",
                           "leave them out of the scene: they then follow the spacing");
    for (const proto::FluidDesc& fluid : scene.fluids)
        if (fluid.particles)
            return usage_error("fluid \"" + fluid.name + "\" has the particles of a file, at one spacing",
                               "scene.fluids", "give it a shape: that is filled at every spacing");
    for (std::size_t k = 0; k < scene.events.size(); ++k) {
        const std::string path = "scene.events[" + std::to_string(k) + "]";
        if (scene.events[k].step)
            return usage_error("a step is at another time with each spacing", path + ".step", "give its time instead");
        if (std::holds_alternative<proto::PauseAction>(scene.events[k].action))
            return usage_error("the runs would stop there", path + ".action", "leave the pause out");
        const auto* change = std::get_if<proto::SetParametersAction>(&scene.events[k].action);
        if (change == nullptr) continue;
        for (const char* name : {"sound_speed", "stiffness"})
            if (change->parameters.contains(name))
                return usage_error("the speed of sound is varied between the runs", path + ".action",
                                   std::string("leave ") + name + " out");
        for (const char* name : kFollowers)
            if (is_set(change->parameters, name))
                return usage_error(std::string(name) + " would be fixed for one spacing", path + ".action",
                                   "leave it out");
    }
    return proto::Done{};
}

std::array<double, 3> choose_spacings(const proto::SceneDesc& scene, double coarsest, double ratio) {
    const std::vector<double> lengths = whole_lengths(scene, coarsest);
    return {coarsest, choose_spacing(lengths, coarsest / ratio), choose_spacing(lengths, coarsest / (ratio * ratio))};
}

proto::Result<std::optional<SoundSpeed>> find_sound_speed(const std::vector<proto::ParameterEntry>& parameters) {
    if (const double* value = find_number(parameters, "sound_speed")) {
        if (*value > 0) return std::optional(SoundSpeed{*value, false, {}});
        return usage_error("the model does not tell the sound speed that it has chosen", "parameters.sound_speed",
                           "give one, ten times the largest speed expected: --set sound_speed=20");
    }
    const double* stiffness = find_number(parameters, "stiffness");
    if (stiffness == nullptr) return std::optional<SoundSpeed>{};
    if (!(*stiffness > 0))
        return usage_error("a fluid without stiffness has no sound speed to vary", "parameters.stiffness",
                           "give one that is greater than 0");
    SoundSpeed found{std::sqrt(*stiffness), true, {}};
    if (const double* time_step = find_number(parameters, "time_step"); time_step != nullptr && *time_step > 0)
        found.time_step = *time_step;
    return std::optional(found);
}

proto::Parameters sound_speed_parameters(const SoundSpeed& found, double factor) {
    const double value = factor * found.value;
    if (!found.is_stiffness) return {{"sound_speed", value}};
    proto::Parameters parameters{{"stiffness", value * value}};
    if (found.time_step) parameters["time_step"] = *found.time_step / factor;
    return parameters;
}

}  // namespace headrace::client
