#include "tests/bench/calibration.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/calibration.cpp"
#include "hwy/foreach_target.h"
// After it, since it is compiled for each target.
#include "hwy/highway.h"
#include "tests/bench/speed_clock.h"

HWY_BEFORE_NAMESPACE();
namespace headrace::bench::HWY_NAMESPACE {

double run_fma() {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::ScalableTag<float> d;
    constexpr int kChains = 12, kTurns = 400000;  // enough chains to hide the latency of two units
    const auto factor = hn::Set(d, 0.999f), term = hn::Set(d, 0.001f);
    hn::Vec<decltype(d)> chain[kChains];
    for (int k = 0; k < kChains; ++k) chain[k] = hn::Set(d, 0.1f * static_cast<float>(k));
    StageClock clock;
    for (int turn = 0; turn < kTurns; ++turn) {
#pragma GCC unroll 12
        for (int k = 0; k < kChains; ++k) chain[k] = hn::MulAdd(chain[k], factor, term);
    }
    const double seconds = clock.lap();
    auto sum = chain[0];
    for (int k = 1; k < kChains; ++k) sum = hn::Add(sum, chain[k]);
    volatile float keep = hn::GetLane(hn::SumOfLanes(d, sum));
    static_cast<void>(keep);
    return 2.0 * static_cast<double>(hn::Lanes(d)) * kChains * kTurns / seconds * 1e-9;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace headrace::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace headrace::bench {

HWY_EXPORT(run_fma);

double measure_fma_gflops() {
    double best = 0.0;
    for (int window = 0; window < 5; ++window) best = std::max(best, HWY_DYNAMIC_DISPATCH(run_fma)());
    return best;
}

}  // namespace headrace::bench
#endif
