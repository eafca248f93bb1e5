// Collision objects as polygons, for programs that show meshes: boxes as 6 quadrilaterals, spheres and cylinders as
// rings of facets; in 2D closed outlines. Planes have no end and no polygon.
#pragma once

#include <vector>

#include "client/writers/placed_object.h"
#include "client/writers/vtp_file.h"

namespace headrace::client {

// Cell data: `object` (row in `objects`) and `is_container` (1 or 0); field data `names`.
VtpPiece make_object_mesh(const std::vector<PlacedObject>& objects, int dimensions);

}  // namespace headrace::client
