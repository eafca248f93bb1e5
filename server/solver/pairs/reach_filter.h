// The exact test behind the pair list, in the best instruction set of the machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

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

// Moves the candidates that have a point within reach of one of the centre's to the front, in their order; returns
// their number.
std::size_t filter_reach(const ReachQuery<float>& query, Candidate* candidates, std::size_t count);
std::size_t filter_reach(const ReachQuery<double>& query, Candidate* candidates, std::size_t count);

}  // namespace headrace::solver
