// The blocks of neighbours near a block of centres, found once for all of its clusters, and the ways to them.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "server/solver/pairs/block_grid.h"
#include "server/solver/pairs/cluster_points.h"
#include "server/solver/pairs/pair_way.h"
#include "server/solver/pairs/reach_filter.h"

namespace headrace::solver {

// Smallest box around places [m].
struct Extent {
    Vec3 low{}, high{};
};
Extent extent_of(const VectorField& x, int dimensions, std::size_t begin, std::size_t end);

template <class S>
class NearBlocks {
  public:
    struct Setting {
        const ClusterPoints<S>* centres{};
        const VectorField* x{};  // of the centres, in their order
        const ClusterPoints<S>* neighbours{};
        const BlockGrid* grid{};  // of the neighbours
        double reach{};           // [m] that ways lead to
        double far_reach{};       // [m] of the blocks
        Vec3 period{};            // [m]
        bool is_half{};           // are blocks before the centres' left out, and, of their own, half of the images?
    };

    void start(const Setting& setting);

    // Finds the blocks that have a cluster within the far reach of one of the centres [begin, end), and some others.
    void find(std::size_t begin, std::size_t end);
    const std::vector<Index>& blocks() const { return blocks_; }  // each once

    // Adds the ways from the centre clusters [first, end), which have one reference point, to all clusters within reach
    // of the box around them, and some others. sights() are those of the ways added. Half: the first one leads to the
    // centres' own clusters, which have no others before them.
    void add_ways(std::size_t first, std::size_t end, std::vector<PairWay<S>>& ways);
    const std::vector<WaySight>& sights() const { return sights_; }

    // Around the centre cluster's points, relative to its reference point.
    ClusterBox box_of(std::size_t cluster) const;

  private:
    struct Found {  // a block, displaced by image[axis] periods
        Index block{};
        std::array<int, 3> image{};

        auto operator<=>(const Found&) const = default;
    };

    bool is_other_half(const Found& found, std::size_t block) const;
    void add_way(std::size_t centre, const Found& found, std::size_t first, std::size_t end, const ClusterBox& box,
                 std::vector<PairWay<S>>& ways);

    Setting setting_;
    std::vector<Index> stamp_, stamp_of_image_;  // of each block: the last look at it
    Index look_{}, look_of_image_{};
    std::vector<Index> blocks_, kept_;
    std::vector<Found> found_;
    std::vector<WaySight> sights_;
    std::deque<BlockBoxes> parts_;  // of blocks with several reference points
    std::size_t parts_used_{};
};

extern template class NearBlocks<float>;
extern template class NearBlocks<double>;

}  // namespace headrace::solver
