// The fluid particles near points and lines of measurement, found in one pass over the particles for all of them.
//
// Particles are stored in the order of cells, so a block of them is compact: a block whose bounding box is out of reach
// is passed over. With particles in any other order the result is the same, only slower.
#pragma once

#include <span>
#include <vector>

#include "server/solver/objects.h"
#include "server/solver/particles.h"

namespace headrace::probes {

using solver::Vec3;

// All points within `reach` of the straight line from a to b; a point when a = b.
struct Region {
    Vec3 a{};        // [m]
    Vec3 b{};        // [m]
    double reach{};  // [m]
};

struct NearParticle {
    Vec3 x{};            // [m] of the image that is near, where an axis is periodic
    double V{};          // [m^3] m / rho (2D: m^2)
    solver::Index slot;  // in the particles' arrays
};

// One list per region. Its order follows from the particles' order alone, not from the number of threads.
std::vector<std::vector<NearParticle>> find_nearby(const solver::Particles& particles, const solver::Domain& domain,
                                                   std::span<const Region> regions);

}  // namespace headrace::probes
