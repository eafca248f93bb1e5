// Times a case: warm-up, then windows of steps, the thread counts taking turns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "proto/result.h"
#include "tests/bench/cases.h"

namespace headrace::bench {

struct Plan {
    std::vector<int> threads{1};
    int warmup{200};  // steps before the clock starts: the flow shall be developed
    int steps{20};    // per window
    int repeat{5};    // windows per thread count
};

struct StageTime {
    std::string name;
    double ms{};  // [ms] per step, mean over the windows
};

// One case at one thread count.
struct Timing {
    std::string label;
    std::string model;
    int dimensions{};
    std::size_t particles{};
    double spacing{};          // [m]
    double support{};          // [m] support radius; 0: the model has none by that name
    double mean_neighbours{};  // within the support, the particle itself not counted
    double bytes_per_particle{};
    int threads{};
    double best_ms{};    // [ms] per step, of the fastest window
    double median_ms{};  // [ms] per step
    double simulated{};  // [s] per step, mean
    std::vector<StageTime> stages;

    double particle_steps_per_second() const { return static_cast<double>(particles) / (best_ms * 1e-3); }
    double wall_per_simulated_second() const { return best_ms * 1e-3 / simulated; }
};

// Errors: those of scene::Run::build, and `faulted` when the run breaks.
proto::Result<std::vector<Timing>> measure(const Case& one, const Plan& plan);

}  // namespace headrace::bench
