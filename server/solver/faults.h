// Detection of runs that went wrong: bad numbers, particles outside the domain. Every step, every particle.
#pragma once

#include <optional>

#include "server/solver/objects.h"
#include "server/solver/particles.h"
#include "server/solver/step_report.h"

namespace headrace::solver {

struct Inspection {
    double max_speed{};          // [m/s] largest |v| of the particles without fault
    std::optional<Fault> fault;  // of the lowest id that has one; remedy left empty
};

// As clients see it: "non_finite", "left_domain", ...
const char* name_of(FaultKind kind);

Inspection inspect(const Particles& particles, const Domain& domain);

}  // namespace headrace::solver
