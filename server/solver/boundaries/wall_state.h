// What a dummy wall particle stands for in a pair with fluid (Adami, Hu, Adams 2012, J. Comput. Phys. 231, 7057).
//
// Pressure: extrapolated from the fluid with the hydrostatics of the accelerated wall,
//   p_w = [sum_f p_f W_wf + (g - a_w) . sum_f rho_f x_wf W_wf] / sum_f W_wf
// Velocity in the viscosity at a no-slip wall: the fluid's profile continued linearly through the wall's surface,
//   v_w = v_wall - (d_w/d_i) (v_i - v_wall)                               Morris, Fox, Zhu 1997, JCP 136, 214
// with d the distances of dummy and fluid particle from the surface: exact for a linear profile. Differs from Adami et
// al., whose mean of the fluid's velocity is that of another depth.
#pragma once

#include "server/solver/pair.h"

namespace headrace::solver {

// v_i - v_w of the pair at a no-slip wall. depth: d_w [m]; normal: of the wall, into the fluid.
// least_distance: fluid closer to the surface than this counts as being there, or the pair would be too stiff.
template <int D, class T>
HEADRACE_ALWAYS_INLINE VectorOf<D, T> no_slip_difference(const Pair<D, T>& pair, const VectorOf<D, T>& normal,
                                                         const T& depth, const VectorOf<D, T>& v_i,
                                                         const VectorOf<D, T>& v_wall, double least_distance) {
    const T d_i = maximum<T>(dot<D, T>(pair.x_ij, normal) - depth, splat<T>(least_distance));
    VectorOf<D, T> difference;
    for (int k = 0; k < D; ++k) difference[k] = (1.0 + depth / d_i) * (v_i[k] - v_wall[k]);
    return difference;
}

}  // namespace headrace::solver
