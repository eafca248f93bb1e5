// Diffusion of the density deviation, which keeps the pressure smooth:
//
//   D_i = xi h c0 sum_j psi_ij . grad_i W_ij V_j
//   psi_ij = 2 (delta_j - delta_i) x_ji/r^2                                  Molteni & Colagrossi 2009, CPC 180, 861
//   psi_ij = 2 (delta_j - delta_i - delta^H_ij) x_ji/r^2                     Fourtakas et al. 2019, Comput. Fluids 190
//   psi_ij = 2 (delta_j - delta_i) x_ji/r^2 - (<grad delta>_i + <grad delta>_j)   Antuono et al. 2010, CPC 181, 532
//
// with x_ji = x_j - x_i, delta^H_ij = g . x_ji/c0^2 the part that hydrostatics explains (linear state equation), and
// <grad delta> the corrected gradient. The first disturbs still water under gravity and every free surface; it is
// here for comparison. Pairs with walls are left out.
#pragma once

#include "server/solver/pair.h"

namespace headrace::solver {

enum class DensityDiffusion { none, molteni_colagrossi, fourtakas, antuono };

inline constexpr double kUsualDiffusion = 0.1;  // xi, as the three sources use it

// psi . grad W V_j for the first two, with x_ji . grad_i W = -F r^2, F = W'/r. V_F = V_j F, delta_ij = delta_i -
// delta_j, delta_H = -delta^H_ij = g . x_ij/c0^2, or 0 for Molteni & Colagrossi.
template <class T>
HEADRACE_ALWAYS_INLINE T plain_diffusion(const T& V_F, const T& delta_ij, const T& delta_H) {
    return V_F * (2.0 * (delta_ij - delta_H));
}

// The same for Antuono: sum_grad = <grad delta>_i + <grad delta>_j.
template <int D, class T>
HEADRACE_ALWAYS_INLINE T antuono_diffusion(const T& V_F, const VectorOf<D, T>& x_ij, const T& delta_ij,
                                           const VectorOf<D, T>& sum_grad) {
    return V_F * (2.0 * delta_ij - dot<D, T>(sum_grad, x_ij));
}

}  // namespace headrace::solver
