// The exact test behind the pair list, in the best instruction set of the machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "server/solver/pairs/cluster_points.h"
#include "server/solver/pairs/pair_group.h"
#include "server/solver/particles.h"

namespace headrace::solver {

// Candidates [.., end) on one way.
template <class S>
struct CandidateWay {
    std::size_t end{};
    PairWay<S> way;
};

template <class S>
struct ReachQuery {
    int dimensions{};
    const S* centre{};              // record of the centre's cluster
    std::size_t centre_points{};    // points in it: the others are ignored
    const S* records{};             // of the neighbours' clusters
    const Index* clusters{};        // candidates, way by way
    const Index* kept{};            // ascending numbers of those candidates that are looked at
    std::size_t count{};            // of them
    const CandidateWay<S>* ways{};  // ascending
    std::size_t way_count{};
    double reach{};  // [m]
};

// Boxes side by side, [axis][box]. Space for kPadding more is behind them.
struct BoxQuery {
    static constexpr std::size_t kPadding = 16;
    int dimensions{};
    std::array<const float*, 3> centre{}, half{};  // [m]
    std::size_t count{};
    ClusterBox box;
    double reach{};  // [m]
};

// The list of one centre cluster.
template <class S>
struct PruneQuery {
    int dimensions{};
    const S* centre{};            // record of the centre's cluster
    std::size_t centre_points{};  // points in it: the others are ignored
    const S* records{};           // of the neighbours' clusters
    PairGroup* groups{};          // and the next one, which tells where the last one's entries end
    std::size_t group_count{};
    const PairWay<S>* ways{};
    PairEntry* entries{};
    std::uint16_t* seen{};  // of each entry; null: none
    double reach{};         // [m]
    PairEntry* far{};       // scratch for as many entries as the longest group has
    std::uint16_t* far_seen{};
};

// Puts those entries of each group first that have a point within reach of one of the centre's, and sets its end behind
// them. Neither they nor the others change their order.
void prune_to_reach(const PruneQuery<float>& query);
void prune_to_reach(const PruneQuery<double>& query);

// Writes the numbers of the boxes within reach of the query's box, ascending; returns how many. Rounding may add a
// box and loses none. kept: with space for count + kPadding.
std::size_t filter_boxes(const BoxQuery& query, Index* kept);

// Writes the clusters of those candidates that have a point within reach of one of the centre's, in their order, and
// how many had been written at the end of each way. found: with space for count.
void filter_reach(const ReachQuery<float>& query, Index* found, Index* end_of_way);
void filter_reach(const ReachQuery<double>& query, Index* found, Index* end_of_way);

}  // namespace headrace::solver
