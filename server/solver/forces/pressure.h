// Pressure force density f_p [N/m^3] = -sum_{j != i} q_ij grad_W_spiky(x_ij), Staubach 2010, Eq. 2.21 and 2.22.
// Here: q_ij of the pair, by form. V_j = m / rho_j [m^3]. f_p / rho_i is antisymmetric in i and j for both forms.
#pragma once

namespace headrace::solver {

enum class PressureForm { mean, symmetric };

struct PressurePair {
    double p_i, p_j;  // [Pa]
    double rho_i;     // [kg/m^3]
    double V_j;       // [m^3] (2D: m^2)
    double m;         // [kg] (2D: kg/m)
};

template <PressureForm Form>
double pressure_weight(const PressurePair& pair) {
    if constexpr (Form == PressureForm::mean) {
        // q_ij = (p_i + p_j)/2 m/rho_j, Eq. 2.22, the one the thesis applies
        return 0.5 * (pair.p_i + pair.p_j) * pair.V_j;
    } else {
        // q_ij = rho_i (p_i/rho_i^2 + p_j/rho_j^2) m, Eq. 2.21, with p_j/rho_j^2 m = p_j V_j^2 / m
        return pair.m * pair.p_i / pair.rho_i + pair.rho_i * pair.p_j * pair.V_j * pair.V_j / pair.m;
    }
}

}  // namespace headrace::solver
