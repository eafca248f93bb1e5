#include "tests/bench/speed_growth.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "server/scene/run.h"
#include "server/solver/pairs/instruction_sets.h"
#include "tests/bench/peak_memory.h"
#include "tests/bench/speed_clock.h"

namespace headrace::bench {

namespace {

constexpr int kVortexEdge = 46;  // [spacings]
constexpr int kListLife = 24;    // steps: a window has a new list or two
constexpr int kFirstSteps = 1;   // before the clock starts

struct PlainGrowth {
    SpeedRow row;
    PlainFluid fluid;
    std::unique_ptr<PlainSums> sums;
    double best{};  // [s] of a window
};

void step_plain(PlainGrowth& one, StageSeconds& seconds) {
    StageClock clock;
    advance_plain_fluid(one.fluid);
    seconds.integrate += clock.lap();
    one.sums->compute(one.fluid, seconds);
}

PlainGrowth start_plain(std::size_t particles) {
    const PeakMemory memory;
    PlainGrowth one;
    const int edge = static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles))));
    const int waves = std::max(1, static_cast<int>(std::lround(static_cast<double>(edge) / kVortexEdge)));
    one.fluid = make_plain_fluid(3, edge, 3.0, waves);
    one.sums = make_plain_sums(PairStrategy::clusters, 3);
    StageSeconds ignored;
    one.sums->compute(one.fluid, ignored);
    start_plain_fluid(one.fluid);
    for (int step = 0; step < kListLife; ++step) step_plain(one, ignored);
    one.row.particles = one.fluid.size();
    one.row.bytes_per_particle = memory.growth() / static_cast<double>(one.fluid.size());
    return one;
}

void time_window(PlainGrowth& one, int threads) {
    one.row.fma_gflops = std::max(one.row.fma_gflops, measure_fma_gflops());
    StageSeconds seconds;
    for (int step = 0; step < kListLife; ++step) step_plain(one, seconds);
    const double total = seconds.sort + seconds.list + seconds.pair + seconds.integrate;
    if (one.best > 0.0 && total >= one.best) return;
    one.best = total;
    const double scale = threads * 1e9 / (static_cast<double>(one.fluid.size()) * kListLife);
    one.row.Mpsps_per_core = 1e3 / (scale * total);
    one.row.ns_sort = scale * seconds.sort;
    one.row.ns_list = scale * seconds.list;
    one.row.ns_pair = scale * seconds.pair;
    one.row.ns_integrate = scale * seconds.integrate;
}

proto::SceneDesc make_scene(std::size_t particles) {
    constexpr double kColumn = 0.6 * 0.15 * 0.3;  // [m^3]
    // Layers of the column's width, so that its lattice fills tank and column evenly.
    const double layers = std::max(1.0, std::round(0.15 / std::cbrt(kColumn / static_cast<double>(particles))));
    proto::SceneDesc scene = make_dam_break("wcsph", 3);
    scene.spacing = 0.15 / layers;
    return scene;
}

}  // namespace

proto::Status time_plain_growth(const std::vector<std::size_t>& particles, const SpeedPlan& plan,
                                const SpeedSink& sink) {
    const int threads = plan.threads.front();
    omp_set_num_threads(threads);
    std::vector<PlainGrowth> sizes;
    for (const std::size_t count : particles) {
        sizes.push_back(start_plain(count));
        SpeedRow& row = sizes.back().row;
        row.name = "growth_plain_3d";
        row.model = "plain";
        row.strategy = "clusters";
        row.dimensions = 3;
        row.support_over_dp = 3.0;
        row.neighbours = 4.0 / 3.0 * std::numbers::pi * 27.0 - 1.0;
        row.threads = threads;
        row.isa = solver::instruction_set();
        row.steps = kListLife;
    }
    for (int window = 0; window < plan.repeat; ++window)
        for (PlainGrowth& one : sizes) time_window(one, threads);
    for (const PlainGrowth& one : sizes) sink(one.row);
    return proto::Done{};
}

proto::Status time_wcsph_growth(const std::vector<std::size_t>& particles, const SpeedPlan& plan,
                                const SpeedSink& sink) {
    const int threads = plan.threads.front();
    omp_set_num_threads(threads);
    for (const std::size_t count : particles) {
        const PeakMemory memory;
        auto built = scene::Run::build(make_scene(count));
        if (!built) return built.error();
        scene::Run& run = **built;
        SpeedRow row;
        row.name = "growth_wcsph_3d";
        row.model = "wcsph";
        row.strategy = "clusters";
        row.dimensions = 3;
        row.particles = run.particles().size();
        row.support_over_dp = run.model().support_radius() / run.scene().spacing;
        row.threads = threads;
        row.isa = solver::instruction_set();
        row.fma_gflops = measure_fma_gflops();
        for (int step = 0; step < kFirstSteps; ++step)
            if (const auto& report = run.step(); report.fault)
                return proto::Error{proto::ErrorCode::faulted, report.fault->remedy, {}, {}};
        double best = 0.0;
        for (int window = 0; window < plan.repeat; ++window) {
            StageClock clock;
            if (const auto& report = run.step(); report.fault)
                return proto::Error{proto::ErrorCode::faulted, report.fault->remedy, {}, {}};
            const double seconds = clock.lap();
            if (window == 0 || seconds < best) best = seconds;
        }
        row.steps = 1;
        row.Mpsps_per_core = static_cast<double>(row.particles) / (1e6 * threads * best);
        row.ns_pair = 1e3 / row.Mpsps_per_core;  // all stages
        row.bytes_per_particle = memory.growth() / static_cast<double>(row.particles);
        sink(row);
    }
    return proto::Done{};
}

}  // namespace headrace::bench
