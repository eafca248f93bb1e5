// Filling a shape with a lattice of particles.
#pragma once

#include <cstdint>
#include <functional>

#include "proto/scene_desc.h"
#include "server/scene/particle_file.h"

namespace headrace::scene {

// Points of the lattice over the shape's bounding box: cell centres at min + (k + 1/2) spacing, as many cells per axis
// as fit, rounded to the nearest. An upper bound of the particles in the shape; saturates instead of overflowing.
std::int64_t lattice_size(const proto::ShapeDesc& shape, int dimensions, double spacing);

// Calls visit(x) for each lattice point inside the shape, x fastest, then y, then z. visit returns false to end early.
void for_each_lattice_point(const proto::ShapeDesc& shape, int dimensions, double spacing,
                            const std::function<bool(const proto::Vec3&)>& visit);

// How many particles a fluid, all fluids of a scene give, without making them.
// Fluids of files that are not among `files` count as none.
std::int64_t count_particles(const proto::FluidDesc& fluid, int dimensions, double spacing);
std::int64_t count_particles(const proto::SceneDesc& scene, const FluidFiles& files = {});

}  // namespace headrace::scene
