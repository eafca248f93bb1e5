// Values of the fluid's fields at any point, from the particles around it.
//
// Moving least squares of first order (Lancaster, Salkauskas 1981, Math. Comput. 37, 141) with the Wendland C2 kernel
// (Wendland 1995, Adv. Comput. Math. 4, 389) as weight: exact for linear fields, however the particles lie and however
// much of the support is empty. On a wall that makes it an extrapolation from the fluid's side.
//
// With w_j = V_j W_j / sum of V_k W_k, d_j = (x_j - x)/R, the mean s = sum of w_j d_j and the covariance
// C = sum of w_j d_j d_j^T - s s^T:   f(x) = sum of w_j (1 - s^T C^-1 (d_j - s)) f_j.
// The sum of the weights' sizes tells how much the particles' scatter grows on its way to x. Where it is above
// kMostAmplification (x lies far outside the cloud of its neighbours) or C is singular (a single particle, a single
// row), the weights w_j alone are taken (Shepard).
#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "server/probes/nearby.h"

namespace headrace::probes {

// 1 inside the fluid, 2 on a flat wall, 4 in a corner of three, with fluid in order before it; more in spray.
inline constexpr double kMostAmplification = 6.0;

// Wendland C2 in 2 or 3 dimensions; R is the support radius [m], W = 0 from r = R on. [m^-D]
inline double wendland_c2(int dimensions, double R, double r) {
    const double q = r / R;
    if (!(q < 1.0)) return 0.0;
    const double factor =
        dimensions == 3 ? 21.0 / (2.0 * std::numbers::pi * R * R * R) : 7.0 / (std::numbers::pi * R * R);
    const double u = 1.0 - q;
    return factor * u * u * u * u * (1.0 + 4.0 * q);
}

// The same in one dimension: W = 5/(4 R) (1 - q)^3 (1 + 3 q). [m^-1]
inline double wendland_c2_line(double R, double r) {
    const double q = std::abs(r) / R;
    if (!(q < 1.0)) return 0.0;
    const double u = 1.0 - q;
    return 1.25 / R * u * u * u * (1.0 + 3.0 * q);
}

// sum of V_j W_j at x: 1 inside the fluid, 1/2 on a flat surface, 0 out of reach. [1]
double concentration(int dimensions, double R, const Vec3& x, std::span<const NearParticle> near);

// One weight per particle of `near`, so that a field's value at x is the sum of weights[j] * field[near[j].slot].
// False, and no weights, where no particle is within R.
bool make_weights(int dimensions, double R, const Vec3& x, std::span<const NearParticle> near,
                  std::vector<double>& weights);

}  // namespace headrace::probes
