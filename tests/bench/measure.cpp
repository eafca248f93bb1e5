#include "tests/bench/measure.h"

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include "server/scene/run.h"
#include "tests/bench/neighbour_count.h"

namespace headrace::bench {

namespace {

// What one thread count has gathered.
struct Windows {
    std::vector<double> ms;      // per step, one entry per window
    double simulated{};          // [s] over all windows
    std::vector<double> stages;  // [s] over all windows, in the plan's order
};

double resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    double total{}, resident{};
    statm >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

std::optional<proto::Error> advance(scene::Run& run, int steps) {
    for (int i = 0; i < steps; ++i) {
        if (const auto& fault = run.step().fault) {
            proto::Error error;
            error.code = proto::ErrorCode::faulted;
            error.message = "faulted at step " + std::to_string(run.step_number()) + ": " + fault->remedy;
            return error;
        }
    }
    return std::nullopt;
}

std::optional<proto::Error> time_window(scene::Run& run, int steps, Windows& windows) {
    const auto stages_before = run.plan();
    const double time_before = run.time();
    const auto start = std::chrono::steady_clock::now();
    if (auto error = advance(run, steps)) return error;
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;

    windows.ms.push_back(wall.count() / steps);
    windows.simulated += run.time() - time_before;
    const auto stages_after = run.plan();
    windows.stages.resize(stages_after.size());
    for (std::size_t i = 0; i < stages_after.size(); ++i)
        windows.stages[i] += stages_after[i].seconds - stages_before[i].seconds;
    return std::nullopt;
}

double find_support(const solver::Model& model) {
    const solver::ParameterMap parameters = model.parameters();
    const auto found = parameters.find("support_radius");
    const double* value = found == parameters.end() ? nullptr : std::get_if<double>(&found->second);
    return value ? *value : 0.0;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

Timing summarise(Timing common, const Windows& windows, const Plan& plan, const std::vector<solver::Stage>& stages) {
    const double steps = static_cast<double>(plan.steps) * static_cast<double>(windows.ms.size());
    common.best_ms = *std::min_element(windows.ms.begin(), windows.ms.end());
    common.median_ms = median(windows.ms);
    common.simulated = windows.simulated / steps;
    for (std::size_t i = 0; i < stages.size(); ++i)
        if (stages[i].active) common.stages.push_back({stages[i].name, windows.stages[i] / steps * 1e3});
    return common;
}

}  // namespace

proto::Result<std::vector<Timing>> measure(const Case& one, const Plan& plan) {
    const int most_threads = *std::max_element(plan.threads.begin(), plan.threads.end());
    omp_set_num_threads(most_threads);
    const double memory_before = resident_bytes();
    auto built = scene::Run::build(one.scene);
    if (!built) return built.error();
    scene::Run& run = **built;
    if (auto error = advance(run, plan.warmup)) return *error;

    Timing common;
    common.label = one.label;
    common.model = run.model().name();
    common.dimensions = one.scene.dimensions;
    common.particles = run.particles().size();
    common.spacing = one.scene.spacing;
    common.support = find_support(run.model());
    common.mean_neighbours = compute_mean_neighbours(run.particles(), common.support);
    common.bytes_per_particle = (resident_bytes() - memory_before) / static_cast<double>(common.particles);

    // Turns, not blocks: a slow minute of the machine hits every thread count alike.
    std::vector<Windows> windows(plan.threads.size());
    for (int repeat = 0; repeat < plan.repeat; ++repeat) {
        for (std::size_t i = 0; i < plan.threads.size(); ++i) {
            omp_set_num_threads(plan.threads[i]);
            if (auto error = advance(run, 1)) return *error;  // wakes the team
            if (auto error = time_window(run, plan.steps, windows[i])) return *error;
        }
    }

    std::vector<Timing> timings;
    for (std::size_t i = 0; i < plan.threads.size(); ++i) {
        common.threads = plan.threads[i];
        timings.push_back(summarise(common, windows[i], plan, run.plan()));
    }
    return timings;
}

}  // namespace headrace::bench
