// Places and volumes of points as the pair loops read them: four points side by side, relative to a reference point
// near by, so that single precision is as good far from the origin as near it.
//
// Reference points are the centres of cubes whose edge is a power of two [m] of a quarter to half a support radius:
// differences between them are exact. The clusters of a block share one where it is a compact body.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "server/solver/pairs/aligned_array.h"
#include "server/solver/pairs/cluster_order.h"
#include "server/solver/pairs/field_view.h"
#include "server/solver/particles.h"

namespace headrace::solver {

// Range of displacements [m] per axis.
struct MotionBox {
    std::array<float, 3> low{}, high{};
};

// Boxes around the points of a block's clusters, side by side, [axis][cluster]. [m]
struct BlockBoxes {
    static constexpr float kNowhere = 1e18f;  // out of everything's reach; its square is a number
    std::array<std::array<float, kBlockClusters>, 3> low, high;

    void clear() {  // all of them nowhere
        for (auto* bounds : {&low, &high})
            for (auto& of_axis : *bounds) of_axis.fill(kNowhere);
    }
    // Longer by what rounding may take: the clusters of spray are as wide as the scene.
    void set(int axis, std::size_t cluster, double from, double to) {
        constexpr double kRounding = 2.0 * std::numeric_limits<float>::epsilon();
        const double rounding = kRounding * (std::abs(from) + std::abs(to));
        low[axis][cluster] = static_cast<float>(from - rounding);
        high[axis][cluster] = static_cast<float>(to + rounding);
    }
};

// S: float or double.
template <class S>
class ClusterPoints {
  public:
    // The points have got a new order: chooses reference points. moves: will there be an update()?
    void start(const VectorField& x, const FieldView& V, std::size_t count, int dimensions, double support,
               bool moves = true);
    // They have moved, or their volumes have changed. [m], [m^3]
    void update(const VectorField& x, const FieldView& V);

    std::size_t size() const { return count_; }
    std::size_t clusters() const { return (count_ + kClusterSize - 1) / kClusterSize; }
    int dimensions() const { return dimensions_; }

    // x, y, (z), V of the cluster: (D + 1) times four numbers. Places beyond the last point are out of everything's
    // reach.
    const S* record(std::size_t cluster) const { return &records_[cluster * stride_]; }

    const std::array<std::int32_t, 3>& reference(std::size_t cluster) const {
        const std::size_t block = cluster / kBlockClusters, place = cluster % kBlockClusters;
        const unsigned up_to_here = (2u << place) - 2u;  // but for cluster 0
        return references_[first_reference_[block] +
                           static_cast<Index>(std::popcount(other_reference_[block] & up_to_here))];
    }
    double reference_step() const { return step_; }  // [m]
    // The first cluster behind this one that has another reference point or is in another block.
    std::size_t end_of_reference(std::size_t cluster) const {
        const std::size_t place = cluster % kBlockClusters;
        const unsigned later = unsigned{other_reference_[cluster / kBlockClusters]} >> place >> 1;
        const std::size_t end = later == 0 ? kBlockClusters - place : std::size_t(std::countr_zero(later)) + 1;
        return std::min(cluster + end, clusters());
    }
    // When the order was new, each relative to the cluster's reference point; until forget_boxes().
    const BlockBoxes& boxes(std::size_t block) const { return boxes_[block]; }
    void forget_boxes() { std::vector<BlockBoxes>().swap(boxes_); }

    // Displacement counts anew from the places of now.
    void settle();

    // Per block of clusters, bounds of the displacement since start() or settle(), and since start(): sums of those
    // from one update() to the next. So no place of before has to be kept, and they are as good as exact where the
    // points of a block keep their velocities for as long as a list lives.
    const std::vector<MotionBox>& motion() const { return motion_; }
    const std::vector<MotionBox>& total_motion() const { return total_; }
    bool moves() const { return moves_; }  // if not, all motion is 0

  private:
    void choose_references(const VectorField& x, double support);
    template <bool IsStart>
    void pack(const VectorField& x, const FieldView& V);
    template <bool IsStart>
    void pack_axis(const std::vector<double>& x, int axis, std::size_t first, std::size_t last);

    std::size_t count_{};
    int dimensions_{3};
    double step_{};
    std::size_t stride_{};
    AlignedArray<S> records_;
    std::vector<std::array<std::int32_t, 3>> references_;  // those of each block
    std::vector<Index> first_reference_;                   // per block: that of its cluster 0
    std::vector<std::uint16_t> other_reference_;  // per block, bit c: cluster c has another one than the one before
    std::vector<BlockBoxes> boxes_;
    bool moves_{};
    std::vector<MotionBox> motion_, total_;
};

extern template class ClusterPoints<float>;
extern template class ClusterPoints<double>;

}  // namespace headrace::solver
