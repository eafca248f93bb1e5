// The storage order of the pair engine: points in rows along x, so that four in a row are close together.
//
// Space is divided into rows of square cross-section, about as wide as the edge of a cube of four points, and each row
// into bins about a quarter of that long. Points are sorted by row and bin; every four of them are a cluster. Rows are
// walked through to and fro, so that a cluster at a row's end has its other points in the next row's near end.
// Clusters are stored in bundles of neighbouring rows, in a bundle by their place along it: some that stand in a row
// are as compact a body as a few can be, which moves together and has few neighbours. Dense layout: bundles are taken
// strip by strip, each strip layer by layer, so that what is near in space is near in memory however large the whole
// is.
//
// Within a bin points stand in the order of their ids: the order is a function of places and ids alone.
//
// Dense layout: one start index per bin of the points' bounding box. Sparse: where that would take more than kDenseBins
// per point (drops far apart), bins are found by bisection.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "server/solver/objects.h"
#include "server/solver/parallel.h"
#include "server/solver/particles.h"

namespace headrace::solver {

inline constexpr std::size_t kClusterSize = 4;

// Points [begin, end) as they follow one another along the rows, displaced by image[axis] periods.
struct RowRun {
    Index begin{};
    Index end{};
    std::array<int, 3> image{};
};

class ClusterOrder {
  public:
    // Finds the order. spacing [m] sets the width of rows. Along the domain's periodic axes x must be in [min, max).
    void build(const VectorField& x, const std::vector<Index>& id, int dimensions, double spacing,
               const Domain& domain);

    // Puts one array of the points into the order found by build().
    template <class T>
    void permute(std::vector<T>& values, std::vector<T>& scratch) const;

    // After the last permute(): gives the memory back that only permute() needs.
    void forget_moves() { std::vector<Index>().swap(order_); }

    std::size_t size() const { return count_; }
    std::size_t clusters() const { return (size() + kClusterSize - 1) / kClusterSize; }

    // Where the points are stored that are a cluster along the rows, the one of this number.
    Index cluster_at(Index along_rows) const { return cluster_at_[along_rows]; }
    // The same of one point.
    Index slot_at(Index along_rows) const {
        return cluster_at(along_rows / kClusterSize) * static_cast<Index>(kClusterSize) + along_rows % kClusterSize;
    }

    bool is_periodic() const { return period_ != std::array<double, 3>{}; }  // along any axis

    // visit(run) for runs of points that together hold all points within `reach` of the box [low, high], periodic
    // images included, and some others. All runs of one image come in a row.
    template <class Visit>
    void for_each_run(const Vec3& low, const Vec3& high, double reach, Visit&& visit) const;

  private:
    using Bin = std::array<std::int64_t, 3>;  // z, y, x
    static constexpr std::size_t kDenseBins = 8;
    static constexpr std::size_t kDenseMinimum = 65536;

    Bin find_bin(const VectorField& x, std::size_t i) const;
    // Coordinates that compare lexicographically in the order of storage.
    static Bin in_walking_order(const Bin& bin);
    std::size_t number_of(const Bin& bin) const;
    std::int64_t coordinate(double x, int axis) const {
        // Beyond this bin, and for places that are not numbers, points share the outermost bin: a faulted state may be
        // looked at without harm.
        constexpr double kOutermost = 1e15;
        const double bin = (x - origin_[axis]) * inv_side_[axis];
        if (!(bin > -kOutermost)) return static_cast<std::int64_t>(-kOutermost);
        const auto truncated = static_cast<std::int64_t>(std::min(bin, kOutermost));
        return truncated - (bin < static_cast<double>(truncated));  // floor, without a call
    }
    void divide(double spacing, const Domain& domain);
    void measure(const VectorField& x, std::size_t count);
    void order_dense(const VectorField& x, const std::vector<Index>& id);
    void order_sparse(const VectorField& x, const std::vector<Index>& id);
    // What a cluster is stored by whose points are in the bins first to last: bundle and place along it.
    Bin bundle_of(const Bin& first, const Bin& last) const;
    void store_in_bundles(const VectorField& x);
    void place_dense(const std::vector<Bin>& bundles);
    void place_sparse(const std::vector<Bin>& bundles);
    // The points in the bins first..last of a row.
    RowRun find_run(std::int64_t z, std::int64_t y, std::int64_t first, std::int64_t last) const;

    int dimensions_{3};
    std::array<double, 3> side_{}, inv_side_{}, origin_{};  // [m], [1/m], [m] by axis
    std::array<double, 3> period_{};                        // [m]; 0: not periodic
    std::array<std::int64_t, 3> bins_in_period_{};
    Bin lowest_{}, highest_{};  // of the occupied bins
    bool is_dense_{true};
    std::size_t row_{}, layer_{};    // bins from one row, one layer to the next
    std::size_t count_{};            // points
    std::vector<Index> start_;       // dense: [bins + 1]
    std::vector<Bin> bin_of_point_;  // sparse: along the rows, in walking order
    std::vector<Index> cluster_at_;  // [clusters]
    std::vector<Index> order_;       // [count] old slot of the point that belongs into this slot, for permute()
};

template <class T>
void ClusterOrder::permute(std::vector<T>& values, std::vector<T>& scratch) const {
    scratch.resize(count_);
    parallel_for(count_, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) scratch[i] = values[order_[i]];
    });
    values.swap(scratch);
}

template <class Visit>
void ClusterOrder::for_each_run(const Vec3& low, const Vec3& high, double reach, Visit&& visit) const {
    if (count_ == 0) return;
    Bin first{}, last{};       // z, y, x
    Bin image_0{}, image_1{};  // periods that the box's surroundings reach into
    for (int axis = 0; axis < dimensions_; ++axis) {
        const int c = 2 - axis;
        first[c] = coordinate(low[axis] - reach, axis);
        last[c] = coordinate(high[axis] + reach, axis);
        if (bins_in_period_[axis] == 0) continue;
        const auto floor_div = [](std::int64_t a, std::int64_t b) { return a / b - (a % b < 0); };
        image_0[c] = floor_div(first[c], bins_in_period_[axis]);
        image_1[c] = floor_div(last[c], bins_in_period_[axis]);
    }
    const auto gap_to_row = [&](int axis, std::int64_t bin) {
        const double bottom = origin_[axis] + static_cast<double>(bin) * side_[axis], top = bottom + side_[axis];
        return std::max({0.0, bottom - high[axis], low[axis] - top});
    };
    for (std::int64_t iz = image_0[0]; iz <= image_1[0]; ++iz) {
        for (std::int64_t iy = image_0[1]; iy <= image_1[1]; ++iy) {
            for (std::int64_t ix = image_0[2]; ix <= image_1[2]; ++ix) {
                const std::int64_t shift_z = iz * bins_in_period_[2], shift_y = iy * bins_in_period_[1],
                                   shift_x = ix * bins_in_period_[0];
                const std::int64_t z_0 = std::max(first[0], lowest_[0] + shift_z),
                                   z_1 = std::min(last[0], highest_[0] + shift_z),
                                   y_0 = std::max(first[1], lowest_[1] + shift_y),
                                   y_1 = std::min(last[1], highest_[1] + shift_y);
                const std::array<int, 3> image{static_cast<int>(ix), static_cast<int>(iy), static_cast<int>(iz)};
                for (std::int64_t z = z_0; z <= z_1; ++z) {
                    const double gap_z = dimensions_ == 3 ? gap_to_row(2, z) : 0.0;
                    for (std::int64_t y = y_0; y <= y_1; ++y) {
                        const double gap_y = gap_to_row(1, y);
                        const double left2 = reach * reach - gap_z * gap_z - gap_y * gap_y;
                        if (left2 < 0.0) continue;
                        const double left = std::sqrt(left2);
                        RowRun run = find_run(z - shift_z, y - shift_y, coordinate(low[0] - left, 0) - shift_x,
                                              coordinate(high[0] + left, 0) - shift_x);
                        if (run.begin == run.end) continue;
                        run.image = image;
                        visit(run);
                    }
                }
            }
        }
    }
}

}  // namespace headrace::solver
