// Particles in one place: they see the same fluid, have no direction to be pushed apart in, and would stay together for
// ever. (Two fluids in the same place at the start; particles driven into one corner.)
#pragma once

#include <cstdint>

#include "server/solver/particles.h"

namespace headrace::solver {

inline constexpr double kCoincidentWay = 0.01;  // [spacings] that each is moved

// Moves each pair closer than a thousandth of a spacing apart, in opposite directions drawn from its ids and the step.
// Looks at particles that are close in storage: those in one place are in one bin of the order. Returns the number of
// pairs.
std::uint64_t separate_coincident(Particles& particles, double spacing, std::uint64_t step);

}  // namespace headrace::solver
