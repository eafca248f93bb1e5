#include "tests/bench/speed_cases.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>

#include "server/scene/run.h"
#include "server/solver/models/registry.h"
#include "server/solver/pairs/instruction_sets.h"
#include "tests/bench/neighbour_count.h"
#include "tests/bench/peak_memory.h"
#include "tests/bench/speed_clock.h"

namespace headrace::bench {

namespace {

proto::Error faulted(const std::string& message) {
    proto::Error error;
    error.code = proto::ErrorCode::faulted;
    error.message = message;
    return error;
}

double total(const StageSeconds& s) {
    return s.sort + s.list + s.pair + s.integrate;
}

void step_plain(PlainFluid& fluid, PlainSums& sums, StageSeconds& seconds) {
    StageClock clock;
    advance_plain_fluid(fluid);
    seconds.integrate += clock.lap();
    sums.compute(fluid, seconds);
}

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

// One row while it is measured.
struct Contest {
    SpeedRow row;
    PlainFluid fluid;
    std::unique_ptr<PlainSums> sums;
    double best{};  // [s] of a window
};

void time_window(Contest& one, int steps) {
    omp_set_num_threads(one.row.threads);
    const double fma_before = measure_fma_gflops();
    StageSeconds seconds;
    for (int step = 0; step < steps; ++step) step_plain(one.fluid, *one.sums, seconds);
    const double fma = std::max(fma_before, measure_fma_gflops());
    if (one.best > 0.0 && total(seconds) >= one.best) return;
    one.best = total(seconds);
    const double scale = one.row.threads * 1e9 / (static_cast<double>(one.fluid.size()) * steps);
    one.row.steps = steps;
    one.row.Mpsps_per_core = 1e3 / (scale * total(seconds));
    one.row.ns_sort = scale * seconds.sort;
    one.row.ns_list = scale * seconds.list;
    one.row.ns_pair = scale * seconds.pair;
    one.row.ns_integrate = scale * seconds.integrate;
    one.row.fma_gflops = fma;
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

// ---- dam breaks -----------------------------------------------------------------------------------------------------

// "name=value" as the model's table says what the value is; a number, true or false, or a word.
proto::Result<proto::Parameters> read_settings(const std::string& model, const proto::SceneDesc& scene,
                                               const std::vector<std::string>& settings) {
    proto::Parameters parameters;
    const auto table = solver::model_parameter_table(model, scene.dimensions, scene.spacing);
    for (const std::string& setting : settings) {
        const std::size_t sign = setting.find('=');
        const std::string name = setting.substr(0, sign),
                          value = sign == std::string::npos ? "" : setting.substr(sign + 1);
        const auto info = std::find_if(table.begin(), table.end(), [&](const auto& one) { return one.name == name; });
        if (info == table.end() || value.empty()) return faulted("no parameter of " + model + " is set by " + setting);
        if (std::holds_alternative<double>(info->default_value)) {
            char* end = nullptr;
            parameters[name] = std::strtod(value.c_str(), &end);
            if (*end != '\0') return faulted(setting + ": not a number");
        } else if (std::holds_alternative<bool>(info->default_value)) {
            if (value != "true" && value != "false") return faulted(setting + ": neither true nor false");
            parameters[name] = value == "true";
        } else if (std::holds_alternative<std::string>(info->default_value)) {
            parameters[name] = value;
        } else {
            return faulted(setting + ": vectors cannot be set");
        }
    }
    return parameters;
}

double number_of(const solver::Model& model, const std::string& name, double otherwise) {
    const solver::ParameterMap parameters = model.parameters();
    const auto found = parameters.find(name);
    const double* value = found == parameters.end() ? nullptr : std::get_if<double>(&found->second);
    return value ? *value : otherwise;
}

// Acoustic steps in a step of this length, by the model's own criterion; 1 in models that have none.
double acoustic_steps_in(const scene::Run& run, double dt, double max_speed_before) {
    const double cfl = number_of(run.model(), "cfl", 0.0), c0 = number_of(run.model(), "sound_speed", 0.0);
    if (cfl == 0.0) return 1.0;
    const double acoustic = cfl * 0.5 * run.model().support_radius() / (c0 + max_speed_before);
    return std::max(1.0, std::ceil(dt / acoustic - 1e-6));
}

// Totals of one thread count over its windows.
struct DamBreakTotals {
    double seconds{}, simulated{}, acoustic{};  // [s], [s], [1]
    int steps{};
    StageSeconds stages;
    double fma{};
};

StageSeconds stages_of(const scene::Run& run) {
    StageSeconds seconds;
    for (const solver::Stage& stage : run.plan()) {
        if (stage.name == "neighbours") {
            seconds.list += stage.seconds;
        } else if (stage.name == "advance" || stage.name == "shifting" || stage.name == "integrate" ||
                   stage.name == "check") {
            seconds.integrate += stage.seconds;
        } else {
            seconds.pair += stage.seconds;
        }
    }
    return seconds;
}

void add_difference(StageSeconds& sum, const StageSeconds& after, const StageSeconds& before) {
    sum.sort += after.sort - before.sort;
    sum.list += after.list - before.list;
    sum.pair += after.pair - before.pair;
    sum.integrate += after.integrate - before.integrate;
}

// Steps until `end` [s] or so many.
proto::Status advance(scene::Run& run, double end, int most_steps, DamBreakTotals& totals) {
    const StageSeconds before = stages_of(run);
    StageClock clock;
    for (int step = 0; step < most_steps && run.time() < end; ++step) {
        const double max_speed = run.last_report().max_speed;
        const solver::StepReport& report = run.step();
        if (report.fault) return faulted("faulted at " + std::to_string(run.time()) + " s: " + report.fault->remedy);
        totals.acoustic += acoustic_steps_in(run, report.dt, max_speed);
        totals.simulated += report.dt;
        ++totals.steps;
    }
    totals.seconds += clock.lap();
    add_difference(totals.stages, stages_of(run), before);
    return proto::Done{};
}

SpeedRow summarise(SpeedRow row, int threads, const DamBreakTotals& totals) {
    row.threads = threads;
    row.steps = totals.steps;
    row.fma_gflops = totals.fma;
    row.acoustic_steps = totals.acoustic / totals.steps;
    row.wall_per_simulated_s = totals.seconds / totals.simulated;
    const double scale = threads * 1e9 / (static_cast<double>(row.particles) * totals.steps);
    row.Mpsps_per_core = 1e3 / (scale * totals.seconds);
    // The stages are shares of a wall time that others may have stretched; the total counts.
    const double share = total(totals.stages) > 0.0 ? scale * totals.seconds / total(totals.stages) : 0.0;
    row.ns_sort = share * totals.stages.sort;
    row.ns_list = share * totals.stages.list;
    row.ns_pair = share * totals.stages.pair;
    row.ns_integrate = share * totals.stages.integrate;
    return row;
}

}  // namespace

proto::SceneDesc make_dam_break(const std::string& model, int dimensions) {
    const double width = dimensions == 3 ? 0.15 : 0.0;  // [m]
    proto::SceneDesc scene;
    scene.name = "dam_break";
    scene.dimensions = dimensions;
    scene.model = model;
    scene.spacing = dimensions == 3 ? 0.0075 : 0.003;
    scene.parameters["gravity"] = proto::Vec3{0.0, -9.81, 0.0};
    const double margin = dimensions == 3 ? 0.1 : 0.0;
    scene.domain = {{-0.1, -0.1, -margin}, {1.71, 0.7, width + margin}, {}};
    proto::FluidDesc column;
    column.name = "column";
    column.shape.emplace<proto::BoxDesc>(proto::BoxDesc{{0.0, 0.0, 0.0}, {0.6, 0.3, width}});
    column.hydrostatic = true;
    scene.fluids.push_back(column);
    proto::ObjectDesc tank;
    tank.name = "tank";
    tank.role = proto::ObjectRole::container;
    tank.shape.emplace<proto::BoxDesc>(proto::BoxDesc{{0.0, 0.0, 0.0}, {1.61, 0.6, width}});
    scene.objects.push_back(tank);
    return scene;
}

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

proto::Status time_dam_break(const std::string& model, int dimensions, const SpeedPlan& plan, const SpeedSink& sink) {
    constexpr double kBegin = 0.2, kEnd = 0.4;  // [s]
    omp_set_num_threads(*std::max_element(plan.threads.begin(), plan.threads.end()));
    const PeakMemory memory;
    proto::SceneDesc scene = make_dam_break(model, dimensions);
    auto parameters = read_settings(model, scene, plan.settings);
    if (!parameters) return parameters.error();
    for (const auto& [name, value] : *parameters) scene.parameters.insert_or_assign(name, value);
    auto built = scene::Run::build(scene);
    if (!built) return built.error();
    scene::Run& run = **built;
    DamBreakTotals ignored;
    if (auto status = advance(run, kBegin, 1000000, ignored); !status) return status;

    SpeedRow row;
    row.name = model + (dimensions == 2 ? "_dam_break_2d" : "_dam_break_3d");
    for (const std::string& setting : plan.settings) row.name += "+" + setting;
    row.model = model;
    row.strategy = model == "wcsph" ? "clusters" : "buffer";
    row.dimensions = dimensions;
    row.particles = run.particles().size();
    row.support_over_dp = run.model().support_radius() / run.scene().spacing;
    row.bytes_per_particle = memory.growth() / static_cast<double>(row.particles);
    row.neighbours = compute_mean_neighbours(run.particles(), run.model().support_radius());
    row.isa = solver::instruction_set();

    std::vector<DamBreakTotals> totals(plan.threads.size());
    const double end = plan.is_quick ? kBegin + 0.02 : kEnd;
    while (run.time() < end) {
        for (std::size_t k = 0; k < plan.threads.size() && run.time() < end; ++k) {
            omp_set_num_threads(plan.threads[k]);
            totals[k].fma = std::max(totals[k].fma, measure_fma_gflops());
            if (auto status = advance(run, end, std::max(1, plan.steps / 10), totals[k]); !status) return status;
        }
    }
    for (std::size_t k = 0; k < plan.threads.size(); ++k)
        if (totals[k].steps > 0) sink(summarise(row, plan.threads[k], totals[k]));
    return proto::Done{};
}

}  // namespace headrace::bench
