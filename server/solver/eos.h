// State equation of the thesis model: p [Pa] from rho [kg/m^3].
#pragma once

namespace headrace::solver {

// p = k (rho - rho0), Staubach 2010, Eq. 2.19 (Desbrun 1996, via Müller 2003). k [J/kg] is the square of the speed of
// sound; the thesis prints J. Negative pressures are kept: they hold the surface together.
inline double linear_pressure(double rho, double rho0, double k) {
    return k * (rho - rho0);
}

}  // namespace headrace::solver
