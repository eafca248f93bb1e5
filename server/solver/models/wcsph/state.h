// What the wcsph model carries beside the particles. Arrays are in the particles' (walls': the dummies') order.
//
// What a pair loop computes anew in each step and the next one reads is kept in single precision: its rounding, 6e-8 of
// itself, does not add up from step to step. What is carried on stays in double precision.
#pragma once

#include <array>
#include <vector>

#include "server/solver/boundaries/wall_particles.h"
#include "server/solver/particles.h"

namespace headrace::solver {

// A symmetric matrix per particle: one array per component, see symmetric.h.
using MatrixField = std::array<std::vector<float>, 6>;

struct WcsphState {
    // carried from step to step
    std::vector<double> delta;  // [1] (rho - rho0)/rho0

    // computed once per advective step, at its start; carried through its acoustic steps
    std::vector<float> min_eigenvalue;  // [1] of the moment matrix
    std::vector<float> unevenness;      // [1] |sum V_j grad W| dp
    MatrixField B;                      // [1] gradient correction
    MatrixField strain;                 // [1/s] strain rate; 0 where it is not wanted
    NarrowField grad_delta;             // [1/m] corrected, for the diffusion of Antuono
    NarrowField dx;                     // [m] shift
    NarrowField dv;                     // [m/s] what the shift adds to v
    std::vector<float> ddelta;          // [1] and to delta
    MatrixField surface_stress;         // [1/m] S of the surface; empty without surface tension
    VectorField a_slow;  // [m/s^2] gravity, body force, viscosity, surface tension; empty where gravity is all

    // computed in each acoustic step
    std::vector<double> delta_rate;  // [1/s]
};

// What the dummy particles have been given by the fluid, in their order.
struct WallState {
    std::vector<float> no_slip;  // 1 or 0; empty: 0 everywhere
    VectorField g;         // [m/s^2] of gravity and body force there, less the wall's own acceleration; empty where
                           // it is gravity everywhere
    std::vector<float> p;  // [Pa] extrapolated

    double no_slip_of(std::size_t w) const { return no_slip.empty() ? 0.0 : static_cast<double>(no_slip[w]); }
};

}  // namespace headrace::solver
