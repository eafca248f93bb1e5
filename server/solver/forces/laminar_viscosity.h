// Viscosity of a Newtonian fluid, kinematic viscosity nu = mu/rho0, in two forms:
//
//   Morris            a_i = (mu/rho_i) sum_j 2 V_j (v_i - v_j) F_ij               Morris, Fox, Zhu 1997, JCP 136, 214
//   Monaghan-Gingold  a_i = 2 (D + 2) (mu/rho_i) sum_j V_j (v_ij . x_ij/r^2) grad_i W_ij   Monaghan & Gingold 1983
//
// Both with the direction-wise corrected gradient: F_ij is multiplied by x_ij . (B_i + B_j)/2 x_ij/r^2, which is 1 on
// a well-filled neighbourhood and removes the kernel's first-moment error elsewhere. Symmetric in i and j, so momentum
// is kept. At a free surface Morris's form damps waves at half the rate: it knows no condition there; Monaghan and
// Gingold's is free of it.
#pragma once

#include "server/solver/pair.h"
#include "server/solver/symmetric.h"

namespace headrace::solver {

enum class ViscosityForm { automatic, morris, monaghan_gingold };

// F_ij corrected along the pair's direction.
template <int D, class T>
HEADRACE_ALWAYS_INLINE T corrected_factor(const Pair<D, T>& pair, const T& F, const Symmetric<D, T>& mean_B) {
    return F * dot<D, T>(pair.x_ij, mean_B * pair.x_ij) / pair.r2;
}

// To be multiplied by mu/rho_i.
template <int D, class T>
HEADRACE_ALWAYS_INLINE void accumulate_morris(const Pair<D, T>& pair, const T& F, const VectorOf<D, T>& v_ij,
                                              VectorOf<D, T>& sum) {
    add_to<D, T>(sum, scaled<D, T>(2.0 * pair.V_j * F, v_ij));
}

template <int D, class T>
HEADRACE_ALWAYS_INLINE void accumulate_monaghan_gingold(const Pair<D, T>& pair, const T& F, const VectorOf<D, T>& v_ij,
                                                        VectorOf<D, T>& sum) {
    const T weight = 2.0 * (D + 2.0) * pair.V_j * F * dot<D, T>(v_ij, pair.x_ij) / pair.r2;
    add_to<D, T>(sum, scaled<D, T>(weight, pair.x_ij));
}

}  // namespace headrace::solver
