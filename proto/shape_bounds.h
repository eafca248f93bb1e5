// Extents of the scene document's shapes, for server and client alike.
#pragma once

#include "proto/scene_desc.h"

namespace headrace::proto {

// [m] Smallest box along the axes that surely holds the shape: exact for boxes, spheres, cylinders and planes; that of
// the first part for a difference, what the parts' boxes have in common for an intersection. Infinite where a plane
// leaves the shape without an end. In 2D the third axis does not count.
BoxDesc bounding_box(const ShapeDesc& shape);

bool is_finite(const BoxDesc& box, int dimensions);

}  // namespace headrace::proto
