// Smoothing kernels as values: W, gradient factor and Laplacian, for 2 and 3 dimensions.
//
// Source: Müller, Charypar, Gross 2003 (the kernels of Staubach 2010, Appendix C); the 2D constants follow from the
// same shapes by normalisation, see notation.md. As in the thesis, `h` of poly6, spiky and viscosity is the SUPPORT
// RADIUS, not a smoothing length: W = 0 from r = h on. `h` of the Gaussian is its standard deviation, without
// compact support.
//
// grad_W(x_ij) = gradient_factor * x_ij with x_ij = x_i - x_j, taken with respect to i. Units: W [m^-D],
// gradient factor [m^-(D+2)], Laplacian [m^-(D+2)]. No function branches, so loops over them vectorise.
#pragma once

#include <cmath>
#include <numbers>

namespace headrace::solver {

// x where positive, else 0: the cut at the support radius.
inline double positive_part(double x) {
    return x > 0.0 ? x : 0.0;
}

constexpr double integer_power(double base, int exponent) {
    double result = 1.0;
    for (int k = 0; k < exponent; ++k) result *= base;
    return result;
}

// 3D: W = 315/(64 pi h^9) (h^2 - r^2)^3, C.1; 2D: 4/(pi h^8) (h^2 - r^2)^3. Takes r^2, so it needs no root.
template <int D>
struct Poly6 {
    double h2;        // [m^2]
    double factor_W;  // [m^-(D+6)]

    explicit Poly6(double h)
        : h2(h * h),
          factor_W(D == 3 ? 315.0 / (64.0 * std::numbers::pi * integer_power(h, 9))
                          : 4.0 / (std::numbers::pi * integer_power(h, 8))) {}

    double W(double r2) const {
        const double d = positive_part(h2 - r2);
        return factor_W * d * d * d;
    }
    double gradient_factor(double r2) const {
        const double d = positive_part(h2 - r2);
        return -6.0 * factor_W * d * d;
    }
    // W'' + (D-1)/r W' = -6 factor_W (h^2 - r^2) (D h^2 - (D+4) r^2)
    double laplacian(double r2) const { return -6.0 * factor_W * positive_part(h2 - r2) * (D * h2 - (D + 4) * r2); }
};

// 3D: W = 15/(pi h^6) (h - r)^3, C.4; 2D: 10/(pi h^5) (h - r)^3. Its slope does not vanish at r = 0.
template <int D>
struct Spiky {
    double h;         // [m]
    double factor_W;  // [m^-(D+3)]

    explicit Spiky(double h_)
        : h(h_),
          factor_W(D == 3 ? 15.0 / (std::numbers::pi * integer_power(h_, 6))
                          : 10.0 / (std::numbers::pi * integer_power(h_, 5))) {}

    double W(double r) const {
        const double d = positive_part(h - r);
        return factor_W * d * d * d;
    }
    // dW/dr [m^-(D+1)]; finite at r = 0.
    double slope(double r) const {
        const double d = positive_part(h - r);
        return -3.0 * factor_W * d * d;
    }
    // inv_r = 1/r, or 0 where the direction is undefined (r = 0): no force there.
    double gradient_factor(double r, double inv_r) const { return slope(r) * inv_r; }
    double laplacian(double r) const {
        const double d = positive_part(h - r);
        return factor_W * d * (6.0 - (D - 1) * 3.0 * d / r);
    }
};

// 3D: W = 15/(2 pi h^3) (-r^3/(2h^3) + r^2/h^2 + h/(2r) - 1), C.7, Laplacian 45/(pi h^6) (h - r).
// 2D: Laplacian 40/(pi h^5) (h - r); W = 40/(pi h^5) (h (r^2 - h^2)/4 - (r^3 - h^3)/9 - h^3/6 ln(r/h)).
template <int D>
struct ViscosityKernel {
    double h;                 // [m]
    double factor_laplacian;  // [m^-(D+3)]

    explicit ViscosityKernel(double h_)
        : h(h_),
          factor_laplacian(D == 3 ? 45.0 / (std::numbers::pi * integer_power(h_, 6))
                                  : 40.0 / (std::numbers::pi * integer_power(h_, 5))) {}

    double W(double r) const {
        if (r >= h) return 0.0;
        const double h3 = h * h * h, r3 = r * r * r;
        if constexpr (D == 3) {
            return factor_laplacian * h3 / 6.0 * (-r3 / (2.0 * h3) + r * r / (h * h) + h / (2.0 * r) - 1.0);
        } else {
            return factor_laplacian * (h * (r * r - h * h) / 4.0 - (r3 - h3) / 9.0 - h3 / 6.0 * std::log(r / h));
        }
    }
    double gradient_factor(double r) const {
        if (r >= h) return 0.0;
        if constexpr (D == 3) {
            return factor_laplacian * (h / 3.0 - r / 4.0 - h * h * h * h / (12.0 * r * r * r));
        } else {
            return factor_laplacian * (h / 2.0 - r / 3.0 - h * h * h / (6.0 * r * r));
        }
    }
    double laplacian(double r) const { return factor_laplacian * positive_part(h - r); }
};

// W = (2 pi h^2)^(-D/2) exp(-r^2/(2 h^2)), Staubach 2010, Eq. 2.13: an example, no model here uses it.
template <int D>
struct IsotropicGaussian {
    double h;         // [m] standard deviation; support is infinite
    double factor_W;  // [m^-D]

    explicit IsotropicGaussian(double h_) : h(h_), factor_W(std::pow(2.0 * std::numbers::pi * h_ * h_, -0.5 * D)) {}

    double W(double r2) const { return factor_W * std::exp(-r2 / (2.0 * h * h)); }
    double gradient_factor(double r2) const { return -W(r2) / (h * h); }
    double laplacian(double r2) const { return W(r2) * (r2 / (h * h) - D) / (h * h); }
};

}  // namespace headrace::solver
