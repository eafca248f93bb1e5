// Space divided into bins of equal size. Along periodic axes whole bins fill the period.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "server/solver/objects.h"
#include "server/solver/particles.h"

namespace headrace::solver {

using Bin = std::array<std::int64_t, 3>;  // z, y, x

struct BinRange {
    Bin lowest{}, highest{};

    std::int64_t width(int c) const { return highest[c] - lowest[c] + 1; }
    // All bins in the range: in floating point, since their number may exceed any integer.
    double bins() const {
        return static_cast<double>(width(0)) * static_cast<double>(width(1)) * static_cast<double>(width(2));
    }
};

class SpaceDivision {
  public:
    // side [m] of the bins, by axis; along a periodic one a little longer.
    void divide(int dimensions, const Vec3& side, const Domain& domain);

    int dimensions() const { return dimensions_; }
    bool is_periodic() const { return period_ != Vec3{}; }                         // along any axis
    std::int64_t bins_in_period(int axis) const { return bins_in_period_[axis]; }  // 0: not periodic

    // Along periodic axes points must be in [min, max).
    Bin find(const VectorField& x, std::size_t i) const;

    std::int64_t coordinate(double x, int axis) const {
        // Beyond this bin, and for places that are not numbers, points share the outermost bin: a faulted state may be
        // looked at without harm.
        constexpr double kOutermost = 1e15;
        const double bin = (x - origin_[axis]) * inv_side_[axis];
        if (!(bin > -kOutermost)) return static_cast<std::int64_t>(-kOutermost);
        const auto truncated = static_cast<std::int64_t>(std::min(bin, kOutermost));
        return truncated - (bin < static_cast<double>(truncated));  // floor, without a call
    }
    double bottom(std::int64_t bin, int axis) const {  // [m]
        return origin_[axis] + static_cast<double>(bin) * side_[axis];
    }

    // Of the first `count` points; 0: of none.
    BinRange range_of(const VectorField& x, std::size_t count) const;

  private:
    int dimensions_{3};
    Vec3 side_{}, inv_side_{}, origin_{};  // [m], [1/m], [m] by axis
    Vec3 period_{};                        // [m]; 0: not periodic
    std::array<std::int64_t, 3> bins_in_period_{};
};

}  // namespace headrace::solver
