// The plain fluid (speed_plain.h) in developed flow, by several strategies.
#pragma once

#include <cstddef>
#include <vector>

#include "proto/result.h"
#include "tests/bench/speed_case.h"
#include "tests/bench/speed_sums.h"

namespace headrace::bench {

struct PlainCase {
    int dimensions{3};
    double support_over_dp{3.0};
    std::size_t particles{};  // about so many: a whole cube or square
    std::vector<PairStrategy> strategies;
    bool all_instruction_sets{false};  // of the clusters, with the first of the thread counts
    bool is_jittered{false};           // no flow before the clock starts: the lattice, jittered
};

// The strategies, thread counts and instruction sets take turns; of each the fastest window counts.
proto::Status time_plain(const PlainCase& one, const SpeedPlan& plan, const SpeedSink& sink);

}  // namespace headrace::bench
