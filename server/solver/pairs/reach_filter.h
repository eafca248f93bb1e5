// The exact test behind the pair list, in the best instruction set of the machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "server/solver/pairs/cluster_points.h"
#include "server/solver/particles.h"

namespace headrace::solver {

// A cluster that may be near, and which of the centre's offsets leads to it.
struct Candidate {
    Index cluster{};
    Index offset{};
};

template <class S>
struct ReachQuery {
    int dimensions{};
    const S* centre{};                  // record of the centre's cluster
    std::size_t centre_points{};        // points in it: the others are ignored
    const S* records{};                 // of the neighbours' clusters
    const std::array<S, 3>* offsets{};  // [m]
    double reach{};                     // [m]
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

// Writes the numbers of the boxes within reach of the query's box, ascending; returns how many. Rounding may add a
// box and loses none. kept: with space for count + kPadding.
std::size_t filter_boxes(const BoxQuery& query, Index* kept);

// Moves the candidates that have a point within reach of one of the centre's to the front, in their order; returns
// their number.
std::size_t filter_reach(const ReachQuery<float>& query, Candidate* candidates, std::size_t count);
std::size_t filter_reach(const ReachQuery<double>& query, Candidate* candidates, std::size_t count);

}  // namespace headrace::solver
