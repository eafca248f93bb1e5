#include "tests/bench/speed_growth.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/scene/run.h"
#include "server/solver/pairs/instruction_sets.h"
#include "tests/bench/calibration.h"
#include "tests/bench/peak_memory.h"
#include "tests/bench/speed_clock.h"
#include "tests/bench/speed_contest.h"
#include "tests/bench/speed_dam_break.h"

namespace headrace::bench {

namespace {

constexpr int kVortexEdge = 46;  // [spacings]
constexpr int kListLife = 24;    // steps: a window has a new list or two
constexpr int kFirstSteps = 1;   // before the clock starts

Contest start_plain(std::size_t particles, PairStrategy strategy) {
    const PeakMemory memory;
    Contest one;
    const int edge = static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles))));
    const int waves = std::max(1, static_cast<int>(std::lround(static_cast<double>(edge) / kVortexEdge)));
    one.fluid = make_plain_fluid(3, edge, 3.0, waves);
    one.sums = make_plain_sums(strategy, 3);
    StageSeconds ignored;
    one.sums->compute(one.fluid, ignored);
    start_plain_fluid(one.fluid);
    for (int step = 0; step < kListLife; ++step) step_plain(one.fluid, *one.sums, ignored);
    one.row.particles = one.fluid.size();
    one.row.bytes_per_particle = memory.growth() / static_cast<double>(one.fluid.size());
    one.row.name = "growth_plain_3d";
    one.row.model = "plain";
    one.row.strategy = pair_strategy_name(strategy);
    one.row.dimensions = 3;
    one.row.support_over_dp = 3.0;
    one.row.neighbours = 4.0 / 3.0 * std::numbers::pi * 27.0 - 1.0;
    one.row.isa = solver::instruction_set();
    return one;
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

proto::Status time_plain_growth(const std::vector<std::size_t>& particles, const std::vector<PairStrategy>& strategies,
                                const SpeedPlan& plan, const SpeedSink& sink) {
    omp_set_num_threads(plan.threads.front());
    for (const PairStrategy strategy : strategies) {
        std::vector<Contest> sizes;
        for (const std::size_t count : particles) {
            sizes.push_back(start_plain(count, strategy));
            sizes.back().row.threads = plan.threads.front();
        }
        for (int window = 0; window < plan.repeat; ++window)
            for (Contest& one : sizes) time_window(one, kListLife);
        for (const Contest& one : sizes) sink(one.row);
    }
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
            if (const auto& report = run.step(); report.fault) return faulted(report.fault->remedy);
        double best = 0.0;
        StageSeconds stages;
        for (int window = 0; window < plan.repeat; ++window) {
            const StageSeconds before = stages_of(run);
            StageClock clock;
            const auto& report = run.step();
            if (report.fault) return faulted(report.fault->remedy);
            const double seconds = clock.lap();
            if (window > 0 && seconds >= best) continue;
            best = seconds;
            stages = stages_of(run) - before;
            row.acoustic_steps = report.acoustic_steps;
        }
        row.steps = 1;
        row.Mpsps_per_core = static_cast<double>(row.particles) / (1e6 * threads * best);
        const double scale = threads * 1e9 / static_cast<double>(row.particles);
        row.ns_list = scale * stages.list;
        row.ns_pair = scale * stages.pair;
        row.ns_integrate = scale * stages.integrate;
        row.bytes_per_particle = memory.growth() / static_cast<double>(row.particles);
        sink(row);
    }
    return proto::Done{};
}

}  // namespace headrace::bench
