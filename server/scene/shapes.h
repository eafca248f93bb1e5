// Shapes of the scene document: extents, insides, moves, and their solver counterparts.
#pragma once

#include "proto/scene_desc.h"
#include "server/solver/objects.h"

namespace headrace::scene {

proto::BoxDesc bounding_box(const proto::ShapeDesc& shape);
proto::Vec3 center_of(const proto::ShapeDesc& shape);
proto::ShapeDesc moved_by(const proto::ShapeDesc& shape, const proto::Vec3& displacement);

// Is x inside the shape grown by `margin` [m]? In 2D the third axis does not count.
bool contains(const proto::ShapeDesc& shape, const proto::Vec3& x, int dimensions, double margin = 0.0);

solver::CollisionObject to_collision_object(const proto::ObjectDesc& object, int dimensions);

}  // namespace headrace::scene
