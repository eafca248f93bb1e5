// The entries of a pair list that lie on one way from the centre's cluster.
#pragma once

#include <array>

#include "server/solver/particles.h"

namespace headrace::solver {

// Entries [begin, listed_end) see the centre's cluster displaced by `offset` [m]: from its reference point and period
// to theirs. Those from `end` on were out of the inner reach when the list was last pruned.
template <class S>
struct PairGroup {
    Index begin{}, end{}, listed_end{};
    std::array<S, 3> offset{};
};

}  // namespace headrace::solver
