// What limits an explicit step of the thesis model. Used for advice when a run has gone wrong; the step itself is
// fixed, as in the thesis.
#pragma once

#include <string_view>

namespace headrace::solver {

struct StepLimit {
    double dt{};                 // [s]
    std::string_view criterion;  // "acoustic" or "viscous"
};

struct LimitInput {
    int dimensions{3};
    double support{};        // [m]
    double stiffness{};      // [J/kg], square of the speed of sound
    double viscosity{};      // [Pa s]
    double particle_mass{};  // [kg] (2D: kg/m)
    double max_speed{};      // [m/s]
};

// The smallest of
//   acoustic  0.4 h / (c + |v|max), c = sqrt(k): Courant number 0.4 (Monaghan 1992) on the support radius
//   viscous   2 / lambda, the fastest decay a pair can have: two particles alone at one point relax with
//             lambda = 2 mu m laplacian_W(0) / (2 m W_poly6(0))^2, and 2.33 with the velocity of 2.36 is stable for
//             lambda dt < 2
StepLimit find_step_limit(const LimitInput& input);

}  // namespace headrace::solver
