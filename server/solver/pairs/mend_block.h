// Mending of lists: pairs that have come within reach are added to a block's list, one by one, where its motion is too
// long for the list's skin. A few drops that shoot off do not wear out everybody's list so.
#pragma once

#include <vector>

#include "server/solver/pairs/cluster_points.h"
#include "server/solver/pairs/pair_list.h"

namespace headrace::solver {

// Adds the pairs within `reach` [m], in the places of now, that block b's list lacks with the clusters of these blocks
// of neighbours. For points without periods whose pairs may all interact. Returns false, and leaves a block of no use,
// where they lie on more ways than entries have numbers for.
template <class S>
bool mend_block(PairBlock<S>& block, std::size_t b, const ClusterPoints<S>& centres, const ClusterPoints<S>& neighbours,
                const std::vector<Index>& neighbour_blocks, double reach);

extern template bool mend_block(PairBlock<float>&, std::size_t, const ClusterPoints<float>&,
                                const ClusterPoints<float>&, const std::vector<Index>&, double);
extern template bool mend_block(PairBlock<double>&, std::size_t, const ClusterPoints<double>&,
                                const ClusterPoints<double>&, const std::vector<Index>&, double);

}  // namespace headrace::solver
