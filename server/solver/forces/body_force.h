// Gravity. Staubach 2010, Eq. 2.26 writes f_g = rho g; the acceleration f_g / rho_i (2.16) is then g itself [m/s^2].
// Differs from the text, which prints rho0 g: that would make gravity depend on compression.
#pragma once

namespace headrace::solver {

inline double body_acceleration(double g) {
    return g;
}

}  // namespace headrace::solver
