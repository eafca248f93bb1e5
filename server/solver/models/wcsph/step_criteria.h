// What limits the steps of the wcsph model, with h = R/2.
//
//   acoustic         cfl h/(c0 + |v|max)                     the pressure-velocity pair
//   advective        cfl_adv h/|v|max                        neighbours, shifting: a fraction of h a step; 0.6 of it
//                                                            where shifting orders a confined flow
//   viscous          cfl_adv/2 h^2 rho0/mu                   Morris, Fox, Zhu 1997 (0.125 with cfl_adv = 0.25); half
//                                                            of it with the form of Monaghan and Gingold
//   body force       cfl_adv sqrt(h/|a|max)                  Monaghan 1992
//   surface tension  cfl_adv sqrt(rho0 h^3/(2 pi sigma))     Brackbill, Kothe, Zemach 1992
//
// With the dual time step (Zhang, Rezavand, Hu 2020, J. Comput. Phys. 404, 109135) the last four limit the step and the
// first its acoustic parts; else all limit the one step.
#pragma once

#include <string_view>

namespace headrace::solver {

struct StepCriteria {
    double h{};                     // [m]
    double sound_speed{};           // [m/s]
    double max_speed{};             // [m/s]
    double max_acceleration{};      // [m/s^2]
    double kinematic_viscosity{};   // [m^2/s]
    double tension_over_density{};  // sigma/rho0 [m^3/s^2]
    double cfl{};
    double advective_cfl{};
    bool orders_confined_flow{};  // by shifting
    int most_acoustic_steps{1};
};

struct StepChoice {
    double dt{};                 // [s]
    int acoustic_steps{1};       // in it
    std::string_view criterion;  // the one that limits dt
};

StepChoice choose_step(const StepCriteria& criteria);

}  // namespace headrace::solver
