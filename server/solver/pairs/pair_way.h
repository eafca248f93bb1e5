// The entries of a pair list, as small as they can be: what the loops read of a list is as much as what they read of
// the particles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/solver/pairs/cluster_points.h"
#include "server/solver/particles.h"

namespace headrace::solver {

// A way from centres to a block of neighbours: they see it displaced by `offset` [m], from its reference point and
// period to theirs.
template <class S>
struct PairWay {
    std::array<S, 3> offset{};
    Index first{};  // cluster of the block

    bool operator==(const PairWay&) const = default;
};

// A cluster of neighbours: the number of the way to its block, and its place in the block.
using PairEntry = std::uint16_t;
inline constexpr Index kMostWays = 65536 / kBlockClusters;
inline constexpr PairEntry make_entry(Index way, Index place) {
    return static_cast<PairEntry>(way * kBlockClusters + place);
}
inline constexpr Index way_of(PairEntry entry) {
    return entry / kBlockClusters;
}
inline constexpr Index place_of(PairEntry entry) {
    return entry % kBlockClusters;
}

// The number of this way among those from `first` on, where it is added if need be. Ways are mostly asked for in the
// same order again: `hint` is where the search starts, and is left behind the way.
template <class S>
Index number_of_way(std::vector<PairWay<S>>& ways, std::size_t first, const PairWay<S>& way, std::size_t& hint) {
    for (std::size_t n = first; n < ways.size(); ++n) {
        if (hint < first || hint >= ways.size()) hint = first;
        if (ways[hint++] == way) return static_cast<Index>(hint - 1 - first);
    }
    ways.push_back(way);
    hint = ways.size();
    return static_cast<Index>(hint - 1 - first);
}

// The entries of a centre's cluster: [begin, that of the next row). Those from `end` on were out of the inner reach
// when the list was made or last pruned.
struct PairRow {
    Index begin{}, end{};
    Index ways{};  // what its entries call way 0
};

}  // namespace headrace::solver
