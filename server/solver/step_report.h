// Outcome of a step. Numerical trouble is data, not an exception.
#pragma once

#include <optional>
#include <string>

#include "server/solver/particles.h"

namespace headrace::solver {

// non_finite, left_domain: found in any model. The others tell that the state is no result any more.
enum class FaultKind {
    non_finite,
    left_domain,
    density,    // far from the rest density
    speed,      // faster than the model's sound
    time_step,  // it has collapsed
};

// The particle that went wrong: the lowest id that is non-finite or outside, else the one that is worst. The particles
// keep the state in which it was found.
struct Fault {
    FaultKind kind{};
    Index particle{};  // id
    Vec3 x{};          // [m] as found (may be non-finite)
    Vec3 v{};          // [m/s]
    std::string remedy;
};

struct StepReport {
    double dt{};            // [s] the step just done
    double max_speed{};     // [m/s] largest |v|
    int acoustic_steps{1};  // parts of it that follow sound; 1 in models that have none
    std::optional<Fault> fault;
};

// One line of the plan: a stage of the step, whether this scene needs it, and why (not).
struct Stage {
    std::string name;
    bool active{true};
    std::string reason;
    double seconds{0.0};  // [s] wall time spent in it since the model was made
};

}  // namespace headrace::solver
