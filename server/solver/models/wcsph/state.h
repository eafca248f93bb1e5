// What the wcsph model carries beside the particles. Arrays are in the particles' (walls': the dummies') order.
#pragma once

#include <array>
#include <vector>

#include "server/solver/boundaries/wall_particles.h"
#include "server/solver/particles.h"

namespace headrace::solver {

// A symmetric matrix per particle: one array per component, see symmetric.h.
using MatrixField = std::array<std::vector<double>, 6>;

struct WcsphState {
    // carried from step to step
    std::vector<double> delta;  // [1] (rho - rho0)/rho0

    // computed once per advective step, at its start; carried through its acoustic steps
    std::vector<double> min_eigenvalue;  // [1] of the moment matrix
    std::vector<double> unevenness;      // [1] |sum V_j grad W| dp
    MatrixField B;                       // [1] gradient correction
    MatrixField strain;                  // [1/s] strain rate; 0 where it is not wanted
    VectorField grad_delta;              // [1/m] corrected, for the diffusion of Antuono
    VectorField dx;                      // [m] shift
    VectorField dv;                      // [m/s] what the shift adds to v
    std::vector<double> ddelta;          // [1] and to delta
    MatrixField surface_stress;          // [1/m] S of the surface; empty without surface tension
    VectorField a_slow;                  // [m/s^2] gravity, body force, viscosity, surface tension

    // computed in each acoustic step
    std::vector<double> V;           // [m^3] m/rho
    MatrixField pB;                  // [Pa] p B
    std::vector<double> delta_rate;  // [1/s]
};

// What the dummy particles have been given by the fluid, in their order.
struct WallState {
    std::vector<double> no_slip;  // 1 or 0
    VectorField g;                // [m/s^2] of gravity and body force there, less the wall's own acceleration
    std::vector<double> p;        // [Pa] extrapolated
    std::vector<double> delta;    // [1] of that pressure
};

}  // namespace headrace::solver
