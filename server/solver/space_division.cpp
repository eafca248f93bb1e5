#include "server/solver/space_division.h"

#include "server/solver/parallel.h"

namespace headrace::solver {

void SpaceDivision::divide(int dimensions, const Vec3& side, const Domain& domain) {
    dimensions_ = dimensions;
    side_ = side;
    origin_ = period_ = {};
    bins_in_period_ = {};
    for (int axis = 0; axis < dimensions; ++axis) {
        inv_side_[axis] = 1.0 / side_[axis];
        if (!domain.periodic[axis]) continue;
        origin_[axis] = domain.min[axis];
        period_[axis] = domain.max[axis] - domain.min[axis];
        const double whole = std::max(1.0, std::floor(period_[axis] / side_[axis]));
        bins_in_period_[axis] = static_cast<std::int64_t>(whole);
        side_[axis] = period_[axis] / whole;
        inv_side_[axis] = whole / period_[axis];
    }
}

Bin SpaceDivision::find(const VectorField& x, std::size_t i) const {
    Bin bin{};
    for (int axis = 0; axis < dimensions_; ++axis) {
        std::int64_t& c = bin[2 - axis];
        c = coordinate(x[axis][i], axis);
        if (bins_in_period_[axis] > 0)  // rounding at the very end
            c = std::clamp<std::int64_t>(c, 0, bins_in_period_[axis] - 1);
    }
    return bin;
}

BinRange SpaceDivision::range_of(const VectorField& x, std::size_t count) const {
    if (count == 0) return {};
    const BinRange none{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
    const auto join = [](BinRange a, const BinRange& b) {
        for (int c = 0; c < 3; ++c) {
            a.lowest[c] = std::min(a.lowest[c], b.lowest[c]);
            a.highest[c] = std::max(a.highest[c], b.highest[c]);
        }
        return a;
    };
    return parallel_reduce(
        count, none,
        [&](std::size_t begin, std::size_t end) {
            BinRange block = none;
            for (std::size_t i = begin; i < end; ++i) {
                const Bin bin = find(x, i);
                block = join(block, {bin, bin});
            }
            return block;
        },
        join);
}

}  // namespace headrace::solver
