// Mass: the rate of the density deviation delta = (rho - rho0)/rho0.
//
//   d delta_i/dt = -(1 + delta_i) sum_j V_j (v_j - v_i) . B_i grad_i W_ij
//
// The continuity equation with the corrected divergence (Bonet & Lok 1999, CMAME 180, 97); delta instead of rho keeps
// the digits that a stiff state equation needs. At walls v_j is the velocity of the wall's material.
#pragma once

#include "server/solver/pair.h"

namespace headrace::solver {

// V_j (v_j - v_i) . B_i grad W. V_F = V_j F, F = W'/r; corrected is B_i x_ij.
template <int D, class T>
HEADRACE_ALWAYS_INLINE T velocity_divergence(const T& V_F, const VectorOf<D, T>& corrected_x_ij,
                                             const VectorOf<D, T>& v_ij) {
    return -(V_F * dot<D, T>(v_ij, corrected_x_ij));
}

}  // namespace headrace::solver
