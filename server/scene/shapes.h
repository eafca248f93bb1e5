// Shapes of the scene document: insides, heights, moves, and their solver counterparts. In 2D the third axis does not
// count anywhere.
#pragma once

#include "proto/scene_desc.h"
#include "proto/shape_bounds.h"
#include "server/solver/objects.h"

namespace headrace::scene {

using proto::bounding_box;

// Centre of the bounding box; of a plane its point.
proto::Vec3 center_of(const proto::ShapeDesc& shape);
proto::ShapeDesc moved_by(const proto::ShapeDesc& shape, const proto::Vec3& displacement);

// Is x inside the shape grown by `margin` [m]? Planes hold the side their normal points away from.
bool contains(const proto::ShapeDesc& shape, const proto::Vec3& x, int dimensions, double margin = 0.0);

// [m] Largest x.up over the shape; `up` has length 1. For a difference that of its first part, for an intersection the
// least of its parts': never too low.
double highest_point(const proto::ShapeDesc& shape, const proto::Vec3& up, int dimensions);

// Precondition: a box, sphere, cylinder or plane.
solver::Primitive to_primitive(const proto::ShapeDesc& shape, int dimensions);

}  // namespace headrace::scene
