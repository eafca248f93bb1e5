// State equations: pressure from density.
#pragma once

#include <cmath>

namespace headrace::solver {

// p = k (rho - rho0), Staubach 2010, Eq. 2.19 (Desbrun 1996, via Müller 2003). k [J/kg] is the square of the speed of
// sound; the thesis prints J. Negative pressures are kept: they hold the surface together.
inline double linear_pressure(double rho, double rho0, double k) {
    return k * (rho - rho0);
}

// The same and Tait's (Cole 1948, as in Monaghan 1994), from the deviation delta = (rho - rho0)/rho0, which keeps the
// digits that rho - rho0 would lose. rho0_c2 = rho0 c0^2 [Pa]; gamma = 1 is the linear equation.
struct StateEquation {
    double rho0_c2{};   // [Pa]
    double gamma{1.0};  // [1]

    double pressure(double delta) const {
        if (gamma == 1.0) return rho0_c2 * delta;
        return rho0_c2 / gamma * std::expm1(gamma * std::log1p(delta));
    }
    double deviation(double p) const {
        if (gamma == 1.0) return p / rho0_c2;
        return std::expm1(std::log1p(gamma * p / rho0_c2) / gamma);
    }
    // Speed of sound in units of c0: d p/d rho = c0^2 (1 + delta)^(gamma - 1).
    double relative_sound_speed(double delta) const {
        return gamma == 1.0 ? 1.0 : std::pow(1.0 + delta, 0.5 * (gamma - 1.0));
    }
    // In still fluid, where the incompressible column above weighs `weight` [Pa]: dp = rho(p) g dz integrated.
    double hydrostatic_pressure(double weight) const {
        const double w = weight / rho0_c2;
        if (gamma == 1.0) return rho0_c2 * std::expm1(w);
        return rho0_c2 / gamma * std::expm1(gamma / (gamma - 1.0) * std::log1p((gamma - 1.0) * w));
    }
    // [J/kg] e with de/drho = p/rho^2 and e(rho0) = 0.
    double internal_energy(double delta, double rho0) const {
        const double c2 = rho0_c2 / rho0;
        if (gamma == 1.0) return c2 * (std::log1p(delta) - delta / (1.0 + delta));
        const double power = std::pow(1.0 + delta, gamma - 1.0);
        return c2 / gamma * ((power - 1.0) / (gamma - 1.0) + 1.0 / (1.0 + delta) - 1.0);
    }
};

}  // namespace headrace::solver
