// Objects of the scene document as the solver sees them, prescribed motion included.
//
// The motion is a function of the absolute simulated time. It is told relative to the object's place in the document;
// an object that objects.move displaces takes its pivot along.
#pragma once

#include <optional>
#include <string>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "server/solver/objects.h"

namespace headrace::scene {

// Errors: scene_invalid below `path` for bad expressions and tables, also for a motion that is not finite at t = 0.
// Precondition: the shape is a valid primitive.
proto::Result<solver::CollisionObject> make_collision_object(const proto::ObjectDesc& object, int dimensions,
                                                             double spacing, const std::string& path);

// What goes on through a periodic axis (a plane, a box or cylinder as long as the period) must stay along it while it
// turns. Errors: scene_invalid below `path`.
proto::Status check_turn(const proto::ObjectDesc& object, const solver::CollisionObject& collision,
                         const solver::Domain& domain, int dimensions, const std::string& path);

proto::ObjectDesc moved_by(const proto::ObjectDesc& object, const proto::Vec3& displacement);

// May the fluid be at x, with `slack` [m] to either side? Planes: on their normal's side; containers: inside;
// obstacles: outside. `state`: of a moving object, where it is.
bool may_hold_fluid(const proto::ObjectDesc& object, const std::optional<solver::RigidState>& state,
                    const proto::Vec3& x, int dimensions, double slack);

}  // namespace headrace::scene
