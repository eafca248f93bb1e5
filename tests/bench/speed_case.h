// What all cases of `headrace_bench speed` share.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "proto/result.h"
#include "tests/bench/speed_report.h"

namespace headrace::bench {

struct SpeedPlan {
    std::vector<int> threads{1};
    int warmup{1000};  // steps of flow before the clock starts; dam breaks go by time
    int steps{100};    // per window
    int repeat{3};     // windows
    bool is_quick{false};
    // Parameters of the models beside their defaults, "name=value": the case is named after them.
    std::vector<std::string> settings;
};

using SpeedSink = std::function<void(const SpeedRow&)>;

inline proto::Error faulted(const std::string& message) {
    proto::Error error;
    error.code = proto::ErrorCode::faulted;
    error.message = message;
    return error;
}

}  // namespace headrace::bench
