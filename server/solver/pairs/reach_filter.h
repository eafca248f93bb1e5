// The tests behind the pair list, in the best instruction set of the machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "server/solver/pairs/cluster_points.h"
#include "server/solver/pairs/pair_way.h"
#include "server/solver/particles.h"

namespace headrace::solver {

// Around points [m].
struct ClusterBox {
    std::array<float, 3> low{}, high{};
};

// How a centre's reference point sees the clusters of a block: a box is displaced by `up` or `down` [m], a little more
// and less than the way's offset, before it is held against theirs.
struct WaySight {
    std::array<float, 3> up{}, down{};
    const BlockBoxes* boxes{};
};

struct WayQuery {
    int dimensions{};
    const WaySight* sights{};  // [count]
    std::size_t count{};
    ClusterBox box;
    double reach{};  // [m]
};

// Writes the numbers of the ways to a cluster within reach of the box, ascending; returns how many. Rounding may add a
// way and loses none. kept: with space for count.
std::size_t filter_ways(const WayQuery& query, Index* kept);

// A centre's cluster and where its neighbours may be.
template <class S>
struct NearQuery {
    int dimensions{};
    const S* centre{};            // record of the centre's cluster
    std::size_t centre_points{};  // points in it: the others are ignored
    ClusterBox box;               // around them
    const PairWay<S>* ways{};
    const WaySight* sights{};  // of each way
    std::size_t way_count{};
    std::size_t skipped{};          // so many clusters of the first way's block are left out
    const S* records{};             // of the neighbours' clusters
    double inner_reach{}, reach{};  // [m]
    Index* maybe{};                 // scratch for space_for_near(way_count) numbers
    PairEntry* far{};               // scratch for as many entries
};

struct ListedEntries {
    std::size_t near{};  // within the inner reach: those that come first
    std::size_t count{};
};

inline constexpr std::size_t space_for_near(std::size_t ways) {
    return (ways + 1) * kBlockClusters;
}

// Writes the entries of the clusters that have a point within the inner reach of one of the centre's, way by way, then
// those within reach. found: with space for space_for_near(way_count).
ListedEntries list_near(const NearQuery<float>& query, PairEntry* found);
ListedEntries list_near(const NearQuery<double>& query, PairEntry* found);

// The row of one centre's cluster.
template <class S>
struct PruneQuery {
    int dimensions{};
    const S* centre{};            // record of the centre's cluster
    std::size_t centre_points{};  // points in it: the others are ignored
    const S* records{};           // of the neighbours' clusters
    const PairWay<S>* ways{};     // of the row
    PairEntry* entries{};         // of the row
    std::uint16_t* seen{};        // of each entry; null: none
    std::size_t count{};          // of entries
    double reach{};               // [m]
    PairEntry* far{};             // scratch for `count` entries
    std::uint16_t* far_seen{};
};

// Puts those entries first that have a point within reach of one of the centre's; returns how many. Neither they nor
// the others change their order.
std::size_t prune_to_reach(const PruneQuery<float>& query);
std::size_t prune_to_reach(const PruneQuery<double>& query);

}  // namespace headrace::solver
