// How stiff the fluid is made: the rule behind the parameter sound_speed.
#pragma once

#include "server/solver/models/wcsph/parameters.h"
#include "server/solver/particles.h"

namespace headrace::solver {

// c0 [m/s] so that the density varies by about delta = 1 %: the largest of
//   10 V              V the largest speed expected; Monaghan 1994, J. Comput. Phys. 110, 399
//   sqrt(F L/delta)   F the body force over the length L
//   sqrt(nu V/(L delta))   the viscous stress           Morris, Fox, Zhu 1997, J. Comput. Phys. 136, 214
//   sqrt(sigma/(rho0 dx delta))   the stress along the surface, sigma over a layer of about a spacing
// particles.a holds the body force beside gravity. wall_speed: of the fastest wall [m/s].
double choose_sound_speed(const WcsphParameters& parameters, const Particles& particles, double spacing,
                          double wall_speed);

}  // namespace headrace::solver
