// The pair sums of the thesis model: density (2.17), and the accelerations of pressure (2.21 or 2.22), viscosity
// (2.25) and surface tension (2.27-2.31), fused into one pass over the neighbours.
//
// Which terms a pass holds is fixed when it is chosen: a table of instances over dimension, pressure form, terms and
// instruction set. The loops know no switch.
//
// Differs from Staubach 2010, Alg. 3.3 and 3.6: each particle gathers from all its neighbours. The mutual half-
// neighbourhood loop writes to both particles of a pair, a data race between threads, and defeats SIMD.
#pragma once

#include "server/solver/candidates.h"
#include "server/solver/isa.h"
#include "server/solver/models/thesis_parameters.h"
#include "server/solver/neighbours.h"

namespace headrace::solver {

// What the sums read. Arrays are in the grid's order.
struct SumInput {
    const CellGrid& grid;
    const ThesisParameters& parameters;
    const Particles& particles;
    const double* volume{};  // [N] V = m / rho [m^3]; not read by the density sum
    std::uint64_t step{};    // drives the direction in which coincident particles part
};

// Each sums for the particles of the cells [first, last).
using DensitySum = void (*)(const SumInput& in, std::size_t first, std::size_t last, Candidates& candidates,
                            double* rho);
using ForceSum = void (*)(const SumInput& in, std::size_t first, std::size_t last, Candidates& candidates,
                          const std::array<double*, 3>& a);

struct ForceTerms {
    PressureForm pressure_form{PressureForm::mean};
    bool viscosity{true};
    bool surface_tension{true};
};

DensitySum choose_density_sum(int dimensions, Isa isa);
ForceSum choose_force_sum(int dimensions, const ForceTerms& terms, Isa isa);

}  // namespace headrace::solver
