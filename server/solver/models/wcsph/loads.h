// Forces between fluid and objects, found by pairs on demand: action equals reaction, so an object feels minus what its
// dummies do to the fluid, m_i times the acceleration by their pressure and their no-slip viscosity, at x_i.
#pragma once

#include <vector>

#include "server/solver/model.h"
#include "server/solver/models/wcsph/pair_terms.h"
#include "server/solver/models/wcsph/sums.h"

namespace headrace::solver {

// Of one dummy on the fluid.
struct WallForce {
    Vec3 pressure{};  // [N] (2D: N/m)
    Vec3 viscosity{};
    Vec3 torque{};  // [N m] (2D: N) of both about the origin
};

struct LoadInput {
    const PairNeighbours* neighbours{};
    const Domain& domain;
    double support{};                // [m]
    const Visibility* thin_walls{};  // null without thin panels
};

// In the dummies' order.
std::vector<WallForce> compute_wall_forces(const LoadInput& in, const WcsphView& view, const WcsphSums& sums,
                                           const TermOptions& options);

// Of the fluid on each object.
std::vector<ObjectLoad> sum_object_loads(const WallParticles& walls, const std::vector<WallForce>& forces,
                                         std::size_t objects);

// What moving walls do to the fluid [W] (2D: W/m): force on the fluid times velocity of the wall.
struct WallPower {
    double pressure{};
    double viscosity{};
};
WallPower compute_wall_power(const WallParticles& walls, const std::vector<WallForce>& forces);

}  // namespace headrace::solver
