// Outcome of a step. Numerical trouble is data, not an exception.
#pragma once

#include <optional>
#include <string>

#include "server/solver/particles.h"

namespace headrace::solver {

enum class FaultKind { non_finite, left_domain };

// The first particle (lowest id) that went wrong. The particles keep the state in which it was found.
struct Fault {
    FaultKind kind{};
    Index particle{};  // id
    Vec3 x{};          // [m] as found (may be non-finite)
    Vec3 v{};          // [m/s]
    std::string remedy;
};

struct StepReport {
    double dt{};         // [s] the step just done
    double max_speed{};  // [m/s] largest |v|
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
