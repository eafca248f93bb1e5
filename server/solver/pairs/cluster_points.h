// Places and volumes of points as the pair loops read them: four points side by side, relative to a reference point of
// their cluster, so that single precision is as good far from the origin as near it.
//
// Reference points are the centres of cubes whose edge is a power of two [m] of two to four support radii: differences
// between them are exact.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/solver/pairs/aligned_array.h"
#include "server/solver/pairs/cluster_order.h"
#include "server/solver/pairs/field_view.h"
#include "server/solver/particles.h"

namespace headrace::solver {

// Clusters whose displacement since the list was built is bounded together.
inline constexpr std::size_t kMotionBlock = 16;

// Range of displacements [m] per axis.
struct MotionBox {
    std::array<float, 3> low{}, high{};
};

// Box around a cluster's points when the order was new, relative to its reference point [m].
struct ClusterBox {
    std::array<float, 3> centre{}, half{};
};

// S: float or double.
template <class S>
class ClusterPoints {
  public:
    // The points have got a new order: chooses reference points. moves: will there be an update()?
    void start(const VectorField& x, const FieldView& V, std::size_t count, int dimensions, double support,
               bool moves = true);
    // They have moved, or their volumes have changed. Finds their displacement since start() or settle(). [m], [m^3]
    void update(const VectorField& x, const FieldView& V);

    std::size_t size() const { return count_; }
    std::size_t clusters() const { return (count_ + kClusterSize - 1) / kClusterSize; }
    int dimensions() const { return dimensions_; }

    // x, y, (z), V of the cluster: (D + 1) times four numbers. Places beyond the last point are out of everything's
    // reach.
    const S* record(std::size_t cluster) const { return &records_[cluster * stride_]; }

    const std::array<std::int32_t, 3>& reference(std::size_t cluster) const { return reference_[cluster]; }
    // The same as a number, unique among reference points within 2^20 steps of each other.
    std::uint64_t reference_key(std::size_t cluster) const {
        const auto part = [&](int k) { return static_cast<std::uint64_t>(reference_[cluster][k] & 0x1fffff); };
        return part(0) | part(1) << 21 | part(2) << 42;
    }
    double reference_step() const { return step_; }  // [m]
    const ClusterBox& box(std::size_t cluster) const { return boxes_[cluster]; }

    // Displacement counts anew from the places of now.
    void settle();

    // Per block of clusters, since start() or settle().
    const std::vector<MotionBox>& motion() const { return motion_; }
    // Since start(): bounds, the sum of those between one settle() and the next.
    const std::vector<MotionBox>& total_motion() const { return total_; }
    bool moves() const { return start_.size() > 0; }  // if not, all motion is 0

  private:
    template <bool IsStart>
    void pack(const VectorField& x, const FieldView& V);

    std::size_t count_{};
    int dimensions_{3};
    double step_{};
    std::size_t stride_{};
    AlignedArray<S> records_;
    std::vector<std::array<std::int32_t, 3>> reference_;
    std::vector<ClusterBox> boxes_;
    AlignedArray<float> start_;  // [clusters][D][4] relative places that motion_ counts from; empty where none moves
    std::vector<MotionBox> motion_, settled_, total_;
};

extern template class ClusterPoints<float>;
extern template class ClusterPoints<double>;

}  // namespace headrace::solver
