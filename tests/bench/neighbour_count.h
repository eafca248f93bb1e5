// How many neighbours particles have, so that timings of different supports can be compared.
#pragma once

#include "server/solver/particles.h"

namespace headrace::bench {

// Mean number of other particles within `support` [m] of a particle, over an even sample of some 20,000 of them.
// 0 when support is 0.
double compute_mean_neighbours(const solver::Particles& particles, double support);

}  // namespace headrace::bench
