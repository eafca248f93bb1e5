// What `headrace_bench speed` times: the plain fluid (speed_plain.h) and dam breaks in developed flow.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "tests/bench/speed_report.h"
#include "tests/bench/speed_sums.h"

namespace headrace::bench {

struct SpeedPlan {
    std::vector<int> threads{1};
    int warmup{1000};  // steps of flow before the clock starts; dam breaks go by time
    int steps{100};    // per window
    int repeat{3};     // windows
    bool is_quick{false};
    proto::Parameters parameters;  // dam breaks: over the model's defaults
};

using SpeedSink = std::function<void(const SpeedRow&)>;

struct PlainCase {
    int dimensions{3};
    double support_over_dp{3.0};
    std::size_t particles{};  // about so many: a whole cube or square
    std::vector<PairStrategy> strategies;
    bool all_instruction_sets{false};  // of the clusters, with the first of the thread counts
};

// The strategies, thread counts and instruction sets take turns; of each the fastest window counts.
proto::Status time_plain(const PlainCase& one, const SpeedPlan& plan, const SpeedSink& sink);

// Water, container box, t = 0.2 to 0.4 s, at the model's defaults: a column 0.6 m long and 0.3 m high in a tank of
// 1.61 m by 0.6 m (in 3D 0.15 m wide), as Lobovsky et al. 2014. Windows of the thread counts take turns.
proto::Status time_dam_break(const std::string& model, int dimensions, const SpeedPlan& plan, const SpeedSink& sink);

// [bytes] that the process holds in memory.
double resident_bytes();

}  // namespace headrace::bench
