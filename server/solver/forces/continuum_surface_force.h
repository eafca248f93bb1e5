// Surface tension as a continuum surface force, f = sigma kappa grad_c (Brackbill, Kothe, Zemach 1992, J. Comput. Phys.
// 100, 335), written as the divergence of a stress along the surface, which conserves momentum (Lafaurie et al. 1994,
// J. Comput. Phys. 113, 134):
//
//   f_i = (2 sigma/C) sum_j V_j (S_i + S_j) grad_i W^t_ij,   S = g |n| (1 - n n/n^2) + s 1
//
// The colour is c_i = sum_j V_j W_ij, fluid and walls alike; n_i = sum_j V_j grad_i W_ij points into the fluid.
// Particles see only the inner half of the step of c: hence the 2. The sum over neighbours that end at the surface and
// the weight g take more from it: C is what they leave of a flat surface, see make_flat_surface(). g is 0 where |n| is
// small: inside the fluid n is noise without direction.
//
// W^t = N (1 - r^2/R^2)^3: under tension pairs clump where W'' > 0. Here that begins at 0.45 R, beyond the nearest
// neighbours; with Wendland's kernels at 0.25 R and less.
//
// Cohesion s = n_flat (c_0 - c) where c < c_0, else 0: the stress alone pushes a particle that sticks out of the
// surface still further, since the pull of its neighbours ends sooner than the pressure does. An isotropic stress
// carries no tension: the pressure balances it.
//
// The stress is of the order of sigma/dx, far above sigma kappa: the fluid must be stiff enough for it, or its surface
// never comes to rest (sound_speed.h).
//
// Not sigma kappa n at each particle: its sum over a drop is not 0. From kappa = -div n/|n| of reliable neighbours the
// drop at rest is smoother, but its momentum grows, and an oscillating drop breaks up.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/solver/pair.h"
#include "server/solver/symmetric.h"

namespace headrace::solver {

// |n| as a share of a flat surface's, between which a particle begins to belong to the surface.
inline constexpr double kNoSurface = 0.1, kFullSurface = 0.4;

// Cohesion begins below this colour: just above that of the outermost layer, half a spacing below a flat surface where
// R = 3 dx. Of four pairs tried, this one brought the pressure of drops at rest nearest to sigma/R.
inline constexpr double kCohesiveColour = 0.75;
inline constexpr double kCohesion = 1.0;

// g of s = |n|/n_flat: 0 below kNoSurface, 1 above kFullSurface, a smooth step between.
inline double surface_weight(double s) {
    const double u = std::clamp((s - kNoSurface) / (kFullSurface - kNoSurface), 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}

// S [1/m] of the gradient n [1/m] and the colour c.
template <int D>
Symmetric<D> surface_stress(const std::array<double, D>& n, double c, double n_flat) {
    const double length = std::sqrt(dot<D, double>(n, n));
    const double weight = surface_weight(length / n_flat);
    const double cohesion = kCohesion * n_flat * std::max(kCohesiveColour - c, 0.0);
    Symmetric<D> S;
    for (int k = 0; k < D; ++k) S(k, k) = weight * length + cohesion;
    if (weight == 0.0) return S;
    for (int k = 0; k < D; ++k) {
        for (int l = k; l < D; ++l) S(k, l) -= weight * n[k] * n[l] / length;
    }
    return S;
}

// W^t, its norm N = 4/(pi R^2) in 2D, 315/(64 pi R^3) in 3D.
template <int D>
class TensionKernel {
  public:
    explicit TensionKernel(double R)
        : inv_R2_(1.0 / (R * R)),
          slope_((D == 2 ? -24.0 / std::numbers::pi : -945.0 / (32.0 * std::numbers::pi) / R) / (R * R * R * R)) {}

    // W'/r
    template <class T>
    HEADRACE_ALWAYS_INLINE T F(const T& r2) const {
        const T u = positive_or_zero(1.0 - r2 * inv_R2_);
        return slope_ * u * u;
    }

  private:
    double inv_R2_, slope_;
};

// A flat surface under the kernel W of support R.
struct FlatSurface {
    double n{};  // |n| at the surface [1/m]
    double C{};  // [1] tension that the sums find there, without the factor C, over sigma
};

// At the depth a, |n| is the integral of W over the plane at distance a. Stretching the surface by e along itself does
// the work 2 sigma e times the integral of g |n| m, m(a): moment of W^t along the surface, 1/2 at it and growing by the
// integral of -F^t x^2 over the plane. For W^t = W and g = 1 this gives C = 3/4.
template <int D, class W>
FlatSurface make_flat_surface(W&& kernel, double R) {
    constexpr int kSlices = 400;  // midpoint rule, error 1e-5 of the whole
    const double step = R / kSlices;
    const TensionKernel<D> tension(R);
    const auto over_plane = [&](double a, auto&& value) {
        double sum = 0.0;
        for (int k = 0; k < kSlices; ++k) {
            const double t = (k + 0.5) * step;
            sum += (D == 2 ? 2.0 : 2.0 * std::numbers::pi * t) * step * value(t, a * a + t * t);
        }
        return sum;
    };
    const auto n_at = [&](double a) { return over_plane(a, [&](double, double r2) { return kernel(std::sqrt(r2)); }); };
    FlatSurface flat{n_at(0.0), 0.0};
    double m = 0.5;
    for (int k = 0; k < kSlices; ++k) {
        const double a = (k + 0.5) * step, n = n_at(a);
        // x is one of the D - 1 directions along the surface
        const double growth = over_plane(a, [&](double t, double r2) { return -tension.F(r2) * t * t / (D - 1); });
        flat.C += 2.0 * step * surface_weight(n / flat.n) * n * (m + 0.5 * step * growth);
        m += step * growth;
    }
    return flat;
}

}  // namespace headrace::solver
