#include "tests/bench/speed_contest.h"

#include <omp.h>

#include <algorithm>

#include "tests/bench/calibration.h"
#include "tests/bench/speed_clock.h"

namespace headrace::bench {

void step_plain(PlainFluid& fluid, PlainSums& sums, StageSeconds& seconds) {
    StageClock clock;
    advance_plain_fluid(fluid);
    seconds.integrate += clock.lap();
    sums.compute(fluid, seconds);
}

void time_window(Contest& one, int steps) {
    omp_set_num_threads(one.row.threads);
    const double fma_before = measure_fma_gflops();
    StageSeconds seconds;
    for (int step = 0; step < steps; ++step) step_plain(one.fluid, *one.sums, seconds);
    const double fma = std::max(fma_before, measure_fma_gflops());
    if (one.best > 0.0 && seconds.total() >= one.best) return;
    one.best = seconds.total();
    const double scale = one.row.threads * 1e9 / (static_cast<double>(one.fluid.size()) * steps);
    one.row.steps = steps;
    one.row.Mpsps_per_core = 1e3 / (scale * seconds.total());
    one.row.ns_sort = scale * seconds.sort;
    one.row.ns_list = scale * seconds.list;
    one.row.ns_pair = scale * seconds.pair;
    one.row.ns_integrate = scale * seconds.integrate;
    one.row.fma_gflops = fma;
}

}  // namespace headrace::bench
