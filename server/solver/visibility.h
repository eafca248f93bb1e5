// Which pairs may interact where thin solids stand between them.
#pragma once

#include <cstddef>

#include "server/solver/particles.h"

namespace headrace::solver {

class Visibility {
  public:
    virtual ~Visibility() = default;

    // May a fluid particle at x interact with wall particle k, in the walls' order?
    virtual bool sees(const Vec3& x, std::size_t k) const = 0;
    // Does the straight line between two fluid particles pass through a thin solid?
    virtual bool is_blocked(const Vec3& x_i, const Vec3& x_j) const = 0;
    // Could any pair with a member within `reach` of x need these two tests?
    virtual bool is_near_thin(const Vec3& x, double reach) const = 0;
};

}  // namespace headrace::solver
