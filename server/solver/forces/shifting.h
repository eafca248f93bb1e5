// Particle shifting: spreads the particles evenly, against the clumps and streaks of Lagrangian motion.
//
//   dx_i = -C U dt 2h sum_j (1 + R (W_ij/W(dx))^n) grad_i W_ij V_j,  R = 0.2, n = 4     after Sun et al. 2017, CMAME
//   315
//
// with U the flow's speed, at most `limit` spacings. At a free surface only the tangential part is kept, in jets and
// spray none: shifting would make the surface swell. v and delta are carried along: v += dx . grad v, and likewise
// delta, so that the fields do not move with the particles.
//
// Differs from Sun et al. in the speed: they write Ma CFL (2h)^2 of one acoustic step; here U dt of the advective one.
#pragma once

#include <algorithm>
#include <cmath>

#include "server/solver/pair.h"

namespace headrace::solver {

inline constexpr double kClumpWeight = 0.2;  // R; the power n is 4

// A lattice that the flow has stretched along its axes is in balance however thin it gets: by symmetry it has no
// gradient to shift along. A random displacement of this share of the way U dt breaks the symmetry in time
// (Taylor-Green from a lattice: without it particles line up and the run ends).
inline constexpr double kShiftNoise = 0.05;

// U = 10 h |grad v|: what the flow does to the particles' order is its velocity gradient's work, not its speed's; a
// body of fluid that falls or is carried along needs no shifting.
inline constexpr double kShiftStrainLength = 10.0;

// (1 + R (W/W(dx))^4) V_j F, to be multiplied by x_ij.
template <int D, class T>
HEADRACE_ALWAYS_INLINE T shifting_factor(const Pair<D, T>& pair, const T& F, const T& W_over_W_dx) {
    const T w2 = W_over_W_dx * W_over_W_dx;
    return pair.V_j * F * (1.0 + kClumpWeight * w2 * w2);
}

// How much shifting a particle needs, 0..1: a pressure far above the flow's dynamic pressure keeps the particles apart
// by itself, and shifting against it only stirs still water.
inline double shifting_need(double dynamic_pressure, double p) {
    return dynamic_pressure / (dynamic_pressure + std::max(p, 0.0) + 1e-300);
}

// Where a surface is in sight and its tension outweighs the flow (sigma/dx > rho v^2), it keeps the particles' order by
// itself, and shifting only stirs and stiffens it: no shifting below this eigenvalue.
inline constexpr double kSurfaceInSight = 0.99;

struct ShiftingLimits {
    double surface_eigenvalue{0.9};  // [1] below: a free surface is in reach, tangential shifting only
    double spray_eigenvalue{0.45};   // [1] below: no shifting
    double longest{};                // [m]
};

// normal: points into the fluid; any length.
template <int D>
std::array<double, D> limit_shift(std::array<double, D> shift, double min_eigenvalue,
                                  const std::array<double, D>& normal, const ShiftingLimits& limits) {
    if (min_eigenvalue < limits.spray_eigenvalue) return {};
    if (min_eigenvalue < limits.surface_eigenvalue) {
        const double n2 = dot<D, double>(normal, normal);
        const double along = n2 > 0.0 ? dot<D, double>(shift, normal) / n2 : 0.0;
        for (int k = 0; k < D; ++k) shift[k] -= along * normal[k];
    }
    const double length = std::sqrt(dot<D, double>(shift, shift));
    if (length > limits.longest) {
        for (double& component : shift) component *= limits.longest / length;
    }
    return shift;
}

}  // namespace headrace::solver
