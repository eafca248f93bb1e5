// Particles in one place: they see the same fluid, have no direction to be pushed apart in, and would stay together for
// ever. (Two fluids in the same place at the start; particles driven into one corner.)
#pragma once

#include <cstdint>

#include "server/solver/neighbours.h"
#include "server/solver/particles.h"

namespace headrace::solver {

inline constexpr double kCoincidentWay = 0.01;  // [spacings] that each is moved

// Moves each pair closer than a thousandth of a spacing apart, in opposite directions drawn from its ids and the step.
// Looks at pairs within a cell of the grid, whose order the particles are in. Returns the number of pairs.
std::uint64_t separate_coincident(Particles& particles, const CellGrid& grid, double spacing, std::uint64_t step);

}  // namespace headrace::solver
