// Artificial viscosity: damps what the particles cannot resolve.
//
//   a_i = alpha h c0 (rho0/rho_i) sum_j pi_ij grad_i W_ij V_j
//   pi_ij = v_ij . x_ij/r^2                                      Monaghan 1992, as in Antuono et al. 2010, CPC 181, 532
//   pi_ij = (v_ij . x_ij - x_ij . S_ij x_ij)/r^2                 reconstructed, S_ij = (S_i + S_j)/2
//
// with S the strain rate from corrected gradients. The reconstructed form leaves out what a linear velocity field
// explains: it damps the motion of particle against particle and not the flow. For separating pairs as well, so that
// it is linear, and symmetric, so that momentum is kept. Pairs with walls are left out.
#pragma once

#include "server/solver/pair.h"
#include "server/solver/symmetric.h"

namespace headrace::solver {

// pi_ij: 0 at r = 0, where the approach v_ij . x_ij vanishes and r2 does not.
template <int D, class T>
HEADRACE_ALWAYS_INLINE T approach_rate(const Pair<D, T>& pair, const T& approach) {
    return approach / pair.r2;
}

// mean_strain = S_ij; Monaghan's form: 0.
template <int D, class T>
HEADRACE_ALWAYS_INLINE T approach_rate(const Pair<D, T>& pair, const VectorOf<D, T>& v_ij,
                                       const Symmetric<D, T>& mean_strain) {
    return approach_rate<D, T>(pair, dot<D, T>(v_ij, pair.x_ij) - dot<D, T>(pair.x_ij, mean_strain * pair.x_ij));
}

}  // namespace headrace::solver
