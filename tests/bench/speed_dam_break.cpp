#include "tests/bench/speed_dam_break.h"

#include <omp.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "server/solver/models/registry.h"
#include "server/solver/pairs/instruction_sets.h"
#include "tests/bench/calibration.h"
#include "tests/bench/neighbour_count.h"
#include "tests/bench/peak_memory.h"
#include "tests/bench/speed_clock.h"

namespace headrace::bench {

namespace {

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

// Totals of one thread count over its windows.
struct DamBreakTotals {
    double seconds{}, simulated{}, acoustic{};  // [s], [s], [1]
    int steps{};
    StageSeconds stages;
    double fma{};
};

// Steps until `end` [s] or so many.
proto::Status advance(scene::Run& run, double end, int most_steps, DamBreakTotals& totals) {
    const StageSeconds before = stages_of(run);
    StageClock clock;
    for (int step = 0; step < most_steps && run.time() < end; ++step) {
        const solver::StepReport& report = run.step();
        if (report.fault) return faulted("faulted at " + std::to_string(run.time()) + " s: " + report.fault->remedy);
        totals.acoustic += report.acoustic_steps;
        totals.simulated += report.dt;
        ++totals.steps;
    }
    totals.seconds += clock.lap();
    totals.stages += stages_of(run) - before;
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
    const double share = totals.stages.total() > 0.0 ? scale * totals.seconds / totals.stages.total() : 0.0;
    row.ns_sort = share * totals.stages.sort;
    row.ns_list = share * totals.stages.list;
    row.ns_pair = share * totals.stages.pair;
    row.ns_integrate = share * totals.stages.integrate;
    return row;
}

}  // namespace

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
