#include "tests/bench/speed_plain_case.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "server/solver/pairs/instruction_sets.h"
#include "tests/bench/peak_memory.h"
#include "tests/bench/speed_contest.h"

namespace headrace::bench {

namespace {

// What the flow is made with, and whose memory and instruction sets are measured.
PairStrategy usual_strategy(const PlainCase& one) {
    const bool is_half = !one.strategies.empty() && one.strategies.front() == PairStrategy::half;
    return is_half ? PairStrategy::half : PairStrategy::clusters;
}

// Flow until it has stirred the lattice.
PlainFluid make_developed_flow(const PlainCase& one, int warmup) {
    const int edge = static_cast<int>(std::lround(std::pow(static_cast<double>(one.particles), 1.0 / one.dimensions)));
    PlainFluid fluid = make_plain_fluid(one.dimensions, edge, one.support_over_dp);
    const auto sums = make_plain_sums(usual_strategy(one), one.dimensions);
    StageSeconds seconds;
    sums->compute(fluid, seconds);
    start_plain_fluid(fluid);
    for (int step = 0; step < warmup; ++step) step_plain(fluid, *sums, seconds);
    return fluid;
}

// Is it the flow it should be? A density that has left its range would be another case.
bool is_sound(const PlainFluid& fluid) {
    const auto [low, high] = std::minmax_element(fluid.delta_half.begin(), fluid.delta_half.end());
    return *low > -0.05 && *high < 0.1;  // false for NaN among the first, and NaN spreads
}

SpeedRow describe(const PlainCase& one, const PlainFluid& fluid) {
    SpeedRow row;
    row.name = one.dimensions == 2 ? "plain_2d" : "plain_3d";
    if (one.is_jittered) row.name += "_jittered";
    row.model = "plain";
    row.dimensions = one.dimensions;
    row.particles = fluid.size();
    row.support_over_dp = one.support_over_dp;
    const double R = one.support_over_dp, pi = std::numbers::pi;  // the fluid fills its period
    row.neighbours = (one.dimensions == 2 ? pi * R * R : 4.0 / 3.0 * pi * R * R * R) - 1.0;
    return row;
}

// Turns of the contests that share an instruction set. bytes: of the strategy that was measured.
proto::Status hold_contests(const PlainFluid& developed, double bytes, SpeedRow row, const std::string& isa,
                            const std::vector<PairStrategy>& strategies, PairStrategy measured, const SpeedPlan& plan,
                            const SpeedSink& sink) {
    const solver::OnlyInstructionSet only(isa);
    row.isa = isa;
    std::vector<Contest> contests;
    for (const PairStrategy strategy : strategies) {
        for (const int threads : plan.threads) {
            Contest& one = contests.emplace_back();
            one.row = row;
            one.row.strategy = pair_strategy_name(strategy);
            one.row.threads = threads;
            one.row.bytes_per_particle = strategy == measured ? bytes : 0.0;
            one.fluid = developed;
            one.sums = make_plain_sums(strategy, row.dimensions);
            StageSeconds first;
            one.sums->compute(one.fluid, first);  // allocates
        }
    }
    for (int window = 0; window < plan.repeat; ++window) {
        for (Contest& one : contests) time_window(one, plan.steps);
    }
    for (const Contest& one : contests) {
        if (!is_sound(one.fluid)) return faulted("the plain fluid broke with " + one.row.strategy);
        sink(one.row);
    }
    return proto::Done{};
}

}  // namespace

proto::Status time_plain(const PlainCase& one, const SpeedPlan& plan, const SpeedSink& sink) {
    omp_set_num_threads(*std::max_element(plan.threads.begin(), plan.threads.end()));
    const PeakMemory memory;
    PlainFluid developed = make_developed_flow(one, one.is_jittered ? 0 : plan.warmup);
    if (!is_sound(developed)) return faulted("the plain fluid broke before it was timed");
    double bytes = 0.0;
    {
        const auto sums = make_plain_sums(usual_strategy(one), one.dimensions);
        StageSeconds seconds;
        sums->compute(developed, seconds);
        bytes = memory.growth() / static_cast<double>(developed.size());
    }
    const SpeedRow row = describe(one, developed);
    const PairStrategy usual = usual_strategy(one);
    const std::vector<std::string> sets = solver::instruction_sets();
    if (auto status = hold_contests(developed, bytes, row, sets.front(), one.strategies, usual, plan, sink); !status)
        return status;
    SpeedPlan alone = plan;
    alone.threads.resize(1);
    for (std::size_t k = 1; k < sets.size() && one.all_instruction_sets; ++k) {
        if (auto status = hold_contests(developed, bytes, row, sets[k], {usual}, usual, alone, sink); !status)
            return status;
    }
    return proto::Done{};
}

}  // namespace headrace::bench
