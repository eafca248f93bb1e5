// Dummy particles of spheres (2D: discs) and cylinders, see wall_sampling.h.
#pragma once

#include <vector>

#include "server/solver/boundaries/wall_sampling.h"

namespace headrace::solver {

void sample_sphere(const Body& body, const Sphere& sphere, const SamplingSpace& space, Index object,
                   std::vector<Dummy>& dummies);
void sample_cylinder(const Body& body, const Cylinder& cylinder, const SamplingSpace& space, Index object,
                     std::vector<Dummy>& dummies);

}  // namespace headrace::solver
