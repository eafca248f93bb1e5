// The scene's accelerations beside the model's gravity: `body_force` and `frame_acceleration`, as the solver's closure.
#pragma once

#include <optional>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "server/solver/model.h"

namespace headrace::scene {

// In a frame that accelerates with a_f the fluid feels -a_f, the same everywhere. A body force that names no position
// is evaluated once a step, any other for each particle. Nothing when both are 0. Errors: scene_invalid.
proto::Result<std::optional<solver::BodyForce>> make_body_force(const proto::SceneDesc& scene);

// Is the acceleration finite at t = 0 for all particles? Errors: scene_invalid with the place.
proto::Status check_body_force(const proto::SceneDesc& scene, const solver::BodyForce& force,
                               const solver::Particles& particles);

}  // namespace headrace::scene
