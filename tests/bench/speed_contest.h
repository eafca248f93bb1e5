// One fluid whose plain sums are timed, window by window: the fastest counts.
#pragma once

#include <memory>

#include "tests/bench/speed_report.h"
#include "tests/bench/speed_sums.h"

namespace headrace::bench {

void step_plain(PlainFluid& fluid, PlainSums& sums, StageSeconds& seconds);

struct Contest {
    SpeedRow row;
    PlainFluid fluid;
    std::unique_ptr<PlainSums> sums;
    double best{};  // [s] of a window
};

// So many steps with the row's threads; the row then tells what the fastest window took.
void time_window(Contest& one, int steps);

}  // namespace headrace::bench
