// What `headrace_bench speed --case growth_...` measures: time and peak memory per particle as their number grows.
#pragma once

#include <cstddef>
#include <vector>

#include "proto/result.h"
#include "tests/bench/speed_case.h"
#include "tests/bench/speed_sums.h"

namespace headrace::bench {

// The plain fluid by each strategy, its vortices equally large whatever the number of particles, so that
// lists last equally long. Windows of the sizes take turns.
proto::Status time_plain_growth(const std::vector<std::size_t>& particles, const std::vector<PairStrategy>& strategies,
                                const SpeedPlan& plan, const SpeedSink& sink);

// wcsph in 3D from the beginning of the dam break, from the scene document on; the column's spacing gives the number.
proto::Status time_wcsph_growth(const std::vector<std::size_t>& particles, const SpeedPlan& plan,
                                const SpeedSink& sink);

}  // namespace headrace::bench
