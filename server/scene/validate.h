// Does the scene make sense? What the JSON decoder cannot know: the model's parameters, counts, names that refer to
// each other, fluid inside containers and outside obstacles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "server/scene/build_control.h"
#include "server/scene/particle_file.h"
#include "server/solver/parameters.h"

namespace headrace::scene {

inline constexpr std::int64_t kMostParticles = 50'000'000;  // 200 bytes each: 10 GB

// Errors: scene_invalid, parameter_not_found, limit_exceeded with a path that starts with "scene"; cancelled.
proto::Status validate(const proto::SceneDesc& scene, BuildControl& control, const FluidFiles& files = {});

proto::Error cancelled_error();

// A shape by itself; a plane, or what has one for a part, may be without an end.
proto::Status validate_shape(const proto::ShapeDesc& shape, int dimensions, const std::string& path);

// One object by itself: finite, positive extents. `path` names it in errors.
proto::Status validate_object(const proto::ObjectDesc& object, int dimensions, const std::string& path);

// A refused parameter as an error; the path is path + "." + name.
proto::Error parameter_error(const solver::ParameterError& refusal, const std::vector<solver::ParameterInfo>& table,
                             const std::string& path);

}  // namespace headrace::scene
