// Where the blocks of an order are: for each box of bins the blocks that have a point in it.
//
// Dense layout: one start index per box in the range of the points. Sparse: where that would take more than kDenseBoxes
// per block (drops far apart), boxes are found by bisection.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "server/solver/particles.h"
#include "server/solver/space_division.h"

namespace headrace::solver {

class BlockGrid {
  public:
    // Every block_size points in the order are a block; order[slot]: the point there. range: of all points. Boxes have
    // 2^box_shift[c] bins along coordinate c and are counted from the lowest bin on.
    void build(const SpaceDivision& division, const BinRange& range, const std::array<int, 3>& box_shift,
               const VectorField& x, const std::vector<Index>& order, std::size_t block_size);

    // visit(block, image) for all blocks with a point that is within `reach` of the box [low, high] once displaced by
    // image[axis] periods, and some others. All visits of one image come in a row, some again and again.
    template <class Visit>
    void for_each_near(const Vec3& low, const Vec3& high, double reach, Visit&& visit) const;

    bool is_periodic() const { return division_.is_periodic(); }  // along any axis

  private:
    static constexpr std::size_t kDenseBoxes = 16;
    static constexpr std::size_t kDenseMinimum = 65536;

    using Box = Bin;
    struct Entries {
        Index begin{}, end{};
    };

    Box box_of(const Bin& bin) const {
        return {(bin[0] - range_.lowest[0]) >> box_shift_[0], (bin[1] - range_.lowest[1]) >> box_shift_[1],
                (bin[2] - range_.lowest[2]) >> box_shift_[2]};
    }
    std::size_t number_of(const Box& box) const {
        return static_cast<std::size_t>((box[0] * boxes_[1] + box[1]) * boxes_[2] + box[2]);
    }
    // In the boxes [first, last] of a row.
    Entries find_entries(const Box& first, std::int64_t last) const;
    // Shortest distance [m] from the range [low, high] of an axis to a row of boxes that is displaced by so many bins.
    double gap_to(int axis, std::int64_t box, std::int64_t shift, double low, double high) const {
        const int c = 2 - axis;
        const std::int64_t bin = range_.lowest[c] + (box << box_shift_[c]) + shift;
        return std::max({0.0, division_.bottom(bin, axis) - high,
                         low - division_.bottom(bin + (std::int64_t{1} << box_shift_[c]), axis)});
    }

    SpaceDivision division_;
    BinRange range_;
    std::array<int, 3> box_shift_{};
    Box boxes_{};  // how many
    bool is_dense_{true};
    std::vector<Index> start_;    // dense: of each box's entries
    std::vector<Box> box_of_;     // sparse: of each entry, ascending
    std::vector<Index> entries_;  // blocks
};

template <class Visit>
void BlockGrid::for_each_near(const Vec3& low, const Vec3& high, double reach, Visit&& visit) const {
    if (entries_.empty()) return;
    Bin first{}, last{};       // z, y, x
    Bin image_0{}, image_1{};  // periods that the box's surroundings reach into
    for (int axis = 0; axis < division_.dimensions(); ++axis) {
        const int c = 2 - axis;
        first[c] = division_.coordinate(low[axis] - reach, axis);
        last[c] = division_.coordinate(high[axis] + reach, axis);
        const std::int64_t period = division_.bins_in_period(axis);
        if (period == 0) continue;
        const auto floor_div = [](std::int64_t a, std::int64_t b) { return a / b - (a % b < 0); };
        image_0[c] = floor_div(first[c], period);
        image_1[c] = floor_div(last[c], period);
    }
    for (std::int64_t iz = image_0[0]; iz <= image_1[0]; ++iz) {
        for (std::int64_t iy = image_0[1]; iy <= image_1[1]; ++iy) {
            for (std::int64_t ix = image_0[2]; ix <= image_1[2]; ++ix) {
                const Bin shift{iz * division_.bins_in_period(2), iy * division_.bins_in_period(1),
                                ix * division_.bins_in_period(0)};
                Bin from, to;
                bool is_empty = false;
                for (int c = 0; c < 3; ++c) {
                    from[c] = std::max(first[c] - shift[c], range_.lowest[c]);
                    to[c] = std::min(last[c] - shift[c], range_.highest[c]);
                    is_empty |= from[c] > to[c];
                }
                if (is_empty) continue;
                const std::array<int, 3> image{static_cast<int>(ix), static_cast<int>(iy), static_cast<int>(iz)};
                const Box box_0 = box_of(from), box_1 = box_of(to);
                for (std::int64_t z = box_0[0]; z <= box_1[0]; ++z) {
                    const double gap_z = division_.dimensions() == 3 ? gap_to(2, z, shift[0], low[2], high[2]) : 0.0;
                    for (std::int64_t y = box_0[1]; y <= box_1[1]; ++y) {
                        const double gap_y = gap_to(1, y, shift[1], low[1], high[1]);
                        const double left2 = reach * reach - gap_z * gap_z - gap_y * gap_y;
                        if (left2 < 0.0) continue;
                        const double left = std::sqrt(left2);
                        Bin nearest = from, farthest = to;
                        nearest[2] = std::max(from[2], division_.coordinate(low[0] - left, 0) - shift[2]);
                        farthest[2] = std::min(to[2], division_.coordinate(high[0] + left, 0) - shift[2]);
                        if (nearest[2] > farthest[2]) continue;
                        const Entries found = find_entries({z, y, box_of(nearest)[2]}, box_of(farthest)[2]);
                        for (Index e = found.begin; e < found.end; ++e) visit(entries_[e], image);
                    }
                }
            }
        }
    }
}

}  // namespace headrace::solver
