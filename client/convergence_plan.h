// The runs of a convergence study of a scene: which spacings, what may not stand in the scene, which parameters each
// run changes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "proto/messages.h"
#include "proto/result.h"
#include "proto/scene_desc.h"

namespace headrace::client {

// The scene's document: a preset's name or a file, with parameters "name=value" put into it. Errors: scene_not_found,
// file_error, parse_error, usage.
proto::Result<proto::SceneDesc> read_scene(const std::string& scene, const std::vector<std::string>& assignments);

// Adds a probe from "NAME=JSON": {"level": {...}}, or a whole probe with `kind` and, say, `interval`.
proto::Status add_probe(proto::SceneDesc& scene, const std::string& word);

// Errors where a study of the scene would say nothing: it has no probes, lengths or times that do not follow the
// spacing, or events at a step.
proto::Status check_refinable(const proto::SceneDesc& scene);

// [m] `coarsest`, and about 1/ratio and 1/ratio^2 of it: such that what the coarsest lattice fills with whole cells
// (fluids, periods) the others fill too. A ratio that fits nothing is taken as it is.
std::array<double, 3> choose_spacings(const proto::SceneDesc& scene, double coarsest, double ratio);

// How the model tells its speed of sound.
struct SoundSpeed {
    double value{};                   // [m/s]
    bool is_stiffness{};              // its square is the parameter `stiffness`
    std::optional<double> time_step;  // [s] fixed, which has to follow
};

// Nothing: the model has none. Error: it does not tell it.
proto::Result<std::optional<SoundSpeed>> find_sound_speed(const std::vector<proto::ParameterEntry>& parameters);

// The parameters that make it `factor` times what was found.
proto::Parameters sound_speed_parameters(const SoundSpeed& found, double factor);

}  // namespace headrace::client
