// A round drop cut from a square lattice has not quite the area of its circle: 0.6 % too much at 20 spacings a radius,
// which alone would be an error of 0.3 % in its semi-axes. So spacing and circle are scaled (by less than 1 %) until
// the particles' area is that of the drop.
#pragma once

#include "proto/scene_desc.h"

namespace headrace::validation {

// Sets the spacing, about radius / resolution, and the circle of the scene's only fluid.
void fit_drop(proto::SceneDesc& scene, double radius, double resolution);

}  // namespace headrace::validation
