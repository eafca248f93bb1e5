// The clusters near a few centre clusters that stand together, found once for all of them.
//
// They are sorted by the way that leads to them. What a centre cluster sees is then a selection of them, way by way.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/solver/pairs/aligned_array.h"
#include "server/solver/pairs/cluster_order.h"
#include "server/solver/pairs/cluster_points.h"
#include "server/solver/pairs/reach_filter.h"

namespace headrace::solver {

// Smallest box around places [m].
struct Extent {
    Vec3 low{}, high{};
};
Extent extent_of(const VectorField& x, int dimensions, std::size_t begin, std::size_t end);
Extent join(const Extent& a, const Extent& b);

// Are the points far apart: spray, or the ends of rows of a ragged body?
bool is_wide(const Extent& extent, int dimensions, double reach);

// Runs near the points [begin, end) within the extent: near the box around them all, or near each of them where it is
// wide.
template <class Visit>
void for_each_run_near(const ClusterOrder& order, const VectorField& x, int dimensions, std::size_t begin,
                       std::size_t end, const Extent& extent, double reach, Visit&& visit) {
    if (!is_wide(extent, dimensions, reach)) {
        order.for_each_run(extent.low, extent.high, reach, visit);
        return;
    }
    for (std::size_t i = begin; i < end; ++i) {
        const Extent point = extent_of(x, dimensions, i, i + 1);
        order.for_each_run(point.low, point.high, reach, visit);
    }
}

template <class S>
class NearbyClusters {
  public:
    struct Setting {
        const ClusterPoints<S>* centres{};
        const VectorField* x{};  // of the centres, in their order
        const ClusterPoints<S>* neighbours{};
        const ClusterOrder* order{};  // of the neighbours
        double reach{};               // [m]
        Vec3 period{};                // [m]
    };

    void start(const Setting& setting);

    // Finds those near the centre clusters from `first` on that stand together, `last` at most; returns the end.
    // extents: of the clusters from `first` on.
    std::size_t find(std::size_t first, std::size_t last, const Extent* extents);

    // Those of them that have a point within reach of one of the centre cluster's, way by way; valid until the next
    // call. The centre must be one of those of find().
    struct Near {
        const Index* clusters{};
        const Index* end_of_way{};  // in clusters
        const CandidateWay<S>* ways{};
        std::size_t way_count{};
    };
    Near near(std::size_t centre);

  private:
    struct Way {
        std::uint64_t key{};  // of the reference point
        Index page{};         // of the clusters
        std::array<std::int32_t, 3> reference{};
        std::array<int, 3> image{};
    };

    struct Candidate {
        Index cluster{};
        Index way{};
    };

    std::size_t end_of_group(std::size_t first, std::size_t last, const Extent* extents, Extent& extent) const;
    void collect(std::size_t first, std::size_t end, const Extent& extent);
    static void drop_repeated(std::vector<Candidate>& candidates);
    Index way_to(std::size_t cluster, std::uint64_t key, const std::array<int, 3>& image);
    void sort_by_way(std::size_t base);
    void set_offsets(const std::array<std::int32_t, 3>& reference);
    double offset_to(const Way& way, const std::array<std::int32_t, 3>& reference, int axis) const {
        return (reference[axis] - way.reference[axis]) * setting_.centres->reference_step() -
               way.image[axis] * setting_.period[axis];
    }

    Setting setting_;
    std::vector<Index> stamp_;  // of each cluster of neighbours: the last look at it
    Index look_{};
    std::vector<Candidate> found_;
    std::vector<Way> ways_;
    std::vector<Index> at_;                              // of each way: where its next candidate goes
    std::array<std::int32_t, 3> base_{}, offsets_of_{};  // reference points
    bool has_offsets_{false};
    std::vector<CandidateWay<S>> to_way_;               // of ways_, from offsets_of_
    std::vector<std::array<float, 3>> shift_;           // [m] of ways_, to base_
    AlignedArray<Index> sorted_;                        // clusters, way by way
    std::array<AlignedArray<float>, 3> centre_, half_;  // of the boxes of sorted_, relative to base_
    AlignedArray<Index> kept_, near_;
    std::vector<Index> end_of_way_;
};

extern template class NearbyClusters<float>;
extern template class NearbyClusters<double>;

}  // namespace headrace::solver
