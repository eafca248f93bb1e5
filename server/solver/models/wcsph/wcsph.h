// The accurate model: weakly compressible SPH with corrected gradients, density diffusion, shifting, and walls of dummy
// particles or of integrals of the kernel. Each step:
//
//   neighbours, moment matrices, shift, slow forces (gravity, body force, viscosity, surface tension)
//   n acoustic steps, each a kick-drift-kick with one pressure evaluation:
//     v += dt/2 a;  x += dt/2 v;  delta += dt rate(x, v);  x += dt/2 v;  walls' pressure;  a;  v += dt/2 a
//
// The pair (delta, v) is staggered: density is advanced with the velocity of the half step, velocity with the pressure
// of the whole one. Fusing the two rates into one evaluation would let acoustic energy grow.
#pragma once

#include <memory>

#include "server/solver/model.h"

namespace headrace::solver {

std::unique_ptr<Model> make_wcsph(int dimensions, double spacing, const ParameterMap& overrides);

}  // namespace headrace::solver
