// Surface tension as a continuum surface force, f = sigma kappa grad_c (Brackbill, Kothe, Zemach 1992, J. Comput. Phys.
// 100, 335), in a form that conserves momentum.
//
// The colour is c_i = sum_j V_j W_ij, fluid and walls alike; n_i = sum_j V_j grad_W_ij points into the fluid. Particles
// see only the inner half of the step of c, so the area of the surface is twice what they sum up:
//
//   E = 2 sigma/C sum_i V_i g(|n_i|),   g(n) = n for a surface, 0 inside
//   f_k = -(1/V_k) dE/dx_k = -2 sigma/C sum_j V_j H_kj (q_k - q_j),   q = g'(|n|) n/|n|,   H = grad grad W
//
// Volumes are held. q is the unit normal where n is large; g' falls smoothly to 0 where n is small, since inside the
// fluid n is noise without direction. C is what g loses of a flat surface: 1 for g = n. A wall has q = 0: it counts as
// fluid and has no surface of its own, so fluid meets it at 90 degrees.
//
// Why not sigma kappa n with kappa = -div n/|n| at each particle: its sum over a drop is not zero, and the drop flies
// away. To first order the form above is the same: for unit normals that vary along the surface with curvature kappa,
// sum_j V_j H (q_i - q_j) = -kappa n_i; a flat surface feels nothing, whatever its particles' distances. With one
// pressure p throughout, -2 p n of the adjoint pressure force (B = 1 at a surface) is balanced by 2 sigma kappa n
// particle by particle where p = sigma kappa.
#pragma once

#include <cmath>
#include <numbers>

#include "server/solver/pair.h"

namespace headrace::solver {

// |n| as a share of a flat surface's, between which a particle begins to belong to the surface.
inline constexpr double kNoSurface = 0.05, kFullSurface = 0.2;

// g' of s = |n|/n_flat: 0 below kNoSurface, 1 above kFullSurface, a smooth step between.
inline double surface_weight(double s) {
    if (s <= kNoSurface) return 0.0;
    if (s >= kFullSurface) return 1.0;
    const double u = (s - kNoSurface) / (kFullSurface - kNoSurface);
    return u * u * (3.0 - 2.0 * u);
}

// q of the gradient n [1/m].
template <int D>
std::array<double, D> surface_direction(const std::array<double, D>& n, double n_flat) {
    const double length = std::sqrt(dot<D, double>(n, n));
    const double weight = surface_weight(length / n_flat);
    if (weight == 0.0) return {};
    std::array<double, D> q = n;
    for (double& component : q) component *= weight / length;
    return q;
}

// V_j H u with H = grad grad W = F 1 + dF/dr x (x) x / r.
template <int D, class T>
HEADRACE_ALWAYS_INLINE void accumulate_hessian(const Pair<D, T>& pair, const T& F, const T& dF_dr,
                                               const VectorOf<D, T>& u, VectorOf<D, T>& sum) {
    const T r = maximum(pair.r, splat<T>(1e-30));  // at r = 0 x_ij is 0, and so is the term
    const T along = pair.V_j * dF_dr / r * dot<D, T>(pair.x_ij, u);
    add_to<D, T>(sum, scaled<D, T>(along, pair.x_ij));
    add_to<D, T>(sum, scaled<D, T>(pair.V_j * F, u));
}

// A flat surface under the kernel W of support R.
struct FlatSurface {
    double n{};  // |n| at the surface [1/m]
    double C{};  // 2 times the integral of g' a |dn/da| over the depth a: what g leaves of the tension [1]
};

// n(a) is the integral of W over the plane at distance a; by parts, the integral of g(n) is that of g' a |dn/da|.
template <int D, class W>
FlatSurface make_flat_surface(W&& kernel, double R) {
    constexpr int kSlices = 400;  // midpoint rule, error 1e-5 of the whole
    const double step = R / kSlices;
    const auto n_at = [&](double a) {
        double sum = 0.0;
        for (int k = 0; k < kSlices; ++k) {
            const double t = (k + 0.5) * step, ring = D == 2 ? 2.0 : 2.0 * std::numbers::pi * t;
            sum += ring * step * kernel(std::sqrt(a * a + t * t));
        }
        return sum;
    };
    FlatSurface flat{n_at(0.0), 0.0};
    double n_before = flat.n;
    for (int k = 0; k < kSlices; ++k) {
        const double n_after = n_at((k + 1) * step);
        flat.C += 2.0 * surface_weight(0.5 * (n_before + n_after) / flat.n) * (k + 0.5) * step * (n_before - n_after);
        n_before = n_after;
    }
    return flat;
}

}  // namespace headrace::solver
