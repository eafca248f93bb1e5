// Which points lie inside walls: what is missing of a probe's support there is no lack of fluid.
#pragma once

#include <vector>

#include "server/solver/boundaries/primitives.h"
#include "server/solver/model.h"

namespace headrace::probes {

// The objects as they stand at one instant; valid as long as the surroundings.
class Solids {
  public:
    Solids(const solver::Surroundings& surroundings, int dimensions);

    // Inside an obstacle, outside a container, or behind a plane?
    bool hold(const solver::Vec3& x) const;

    // Share of a kernel's weight around x that lies outside all solids, by a lattice of R/4; 1 far from walls. [1]
    double open_fraction(const solver::Vec3& x, double R) const;

  private:
    struct Solid {
        solver::Body body;
        std::optional<solver::RigidState> state;  // nothing: at rest
    };
    int dimensions_;
    std::vector<Solid> solids_;
};

}  // namespace headrace::probes
