// Viscous force density f_v [N/m^3] = mu sum_{j != i} (v_j - v_i) V_j laplacian_W_viscosity, Staubach 2010, Eq. 2.25.
// V_j = m / rho_j. Here: the factor of (v_j - v_i). f_v / rho_i is antisymmetric in i and j.
#pragma once

namespace headrace::solver {

// mu [Pa s], V_j [m^3], laplacian_W [m^-5] (2D: m^2, m^-4)
inline double viscosity_weight(double mu, double V_j, double laplacian_W) {
    return mu * V_j * laplacian_W;
}

}  // namespace headrace::solver
