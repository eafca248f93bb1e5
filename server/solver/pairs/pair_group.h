// The entries of a pair list, as small as they can be: what the loops read of a list is as much as what they read of
// the particles.
#pragma once

#include <array>
#include <cstdint>

#include "server/solver/particles.h"

namespace headrace::solver {

// A cluster of neighbours is its page and an entry: its place in the page.
using PairEntry = std::uint16_t;
inline constexpr Index kPageClusters = 65536;
inline constexpr Index page_of(Index cluster) {
    return cluster / kPageClusters * kPageClusters;
}

// A way from a centre's cluster to neighbours: they see it displaced by `offset` [m], from its reference point and
// period to theirs.
template <class S>
struct PairWay {
    Index page{};  // the first cluster of their page
    std::array<S, 3> offset{};

    bool operator==(const PairWay&) const = default;
};

// The entries [begin, that of the next group) that lie on one way. Those from `end` on were out of the inner reach when
// the list was last pruned.
struct PairGroup {
    Index begin{}, end{};
    Index way{};
};

}  // namespace headrace::solver
