// Acceleration by pressure, in two forms of the corrected gradient.
//
//   adjoint      a_i = -(1/rho_i) sum_j V_j (p_i B_i + p_j B_j) grad_i W_ij
//   difference   a_i = -(1/rho_i) sum_j V_j (p_j - p_i) B_i grad_i W_ij
//
// The adjoint form is minus the transpose of the divergence in continuity.h: the pair exchanges kinetic and internal
// energy without loss and conserves momentum (Bonet & Lok 1999, CMAME 180, 97), which a free surface needs. The
// difference form is exact for linear pressure, and does not conserve momentum: for confined flow only.
//
// Tension instability: where p_i < 0 inside the fluid the adjoint form takes (p_j B_j - p_i B_i), which removes the
// attraction of the pair's mean (Sun et al. 2018, Comput. Phys. Commun. 224, 63). That is a repulsion of
// -2 p_i B_i sum_j V_j grad_i W_ij/rho_i: nothing where the particles are spread evenly, and without bound beside a
// crowd, which the particle leaves the faster the more the leaving lowers p_i. So it is left out where they are uneven
// (2D dam break onto a wall, H/dp = 100: in about half the runs such particles shot off at two to five times the jet's
// speed).
#pragma once

#include "server/solver/pair.h"
#include "server/solver/symmetric.h"

namespace headrace::solver {

enum class PressureGradient { automatic, difference, adjoint, plain };

// Where tension may be controlled.
struct TensionLimits {
    double min_eigenvalue{0.9};  // [1] of the moment matrix, at least: inside the fluid
    double unevenness{0.1};      // [1] |sum V_j grad W| dp, at most: 0 on a lattice
};

inline bool controls_tension(double p, double min_eigenvalue, double unevenness, const TensionLimits& limits) {
    return p < 0.0 && min_eigenvalue > limits.min_eigenvalue && unevenness < limits.unevenness;
}

// Sums over the neighbours from which both forms follow.
template <int D, class T>
struct PressureSums {
    VectorOf<D, T> grad_1{};   // sum V_j grad W
    VectorOf<D, T> pB_grad{};  // adjoint: sum V_j p_j B_j grad W; difference: sum V_j p_j grad W
};

// V_F = V_j F, F = W'/r: V_j grad_i W_ij = V_F x_ij, multiplied last, since a product is added in one operation.
template <int D, class T>
HEADRACE_ALWAYS_INLINE void accumulate_adjoint(const T& V_F, const VectorOf<D, T>& x_ij, const Symmetric<D, T>& pB_j,
                                               PressureSums<D, T>& sums) {
    add_to<D, T>(sums.grad_1, scaled<D, T>(V_F, x_ij));
    add_to<D, T>(sums.pB_grad, scaled<D, T>(V_F, pB_j * x_ij));
}

template <int D, class T>
HEADRACE_ALWAYS_INLINE void accumulate_difference(const T& V_F, const VectorOf<D, T>& x_ij, const T& p_j,
                                                  PressureSums<D, T>& sums) {
    add_to<D, T>(sums.grad_1, scaled<D, T>(V_F, x_ij));
    add_to<D, T>(sums.pB_grad, scaled<D, T>(V_F * p_j, x_ij));
}

// sign: +1, or -1 where tension is controlled.
template <int D>
HEADRACE_ALWAYS_INLINE std::array<double, D> adjoint_acceleration(const PressureSums<D, double>& sums,
                                                                  const Symmetric<D>& pB_i, double sign, double rho_i) {
    const std::array<double, D> own = pB_i * sums.grad_1;
    std::array<double, D> a;
    const double scale = -1.0 / rho_i;
    for (int k = 0; k < D; ++k) a[k] = scale * (sign * own[k] + sums.pB_grad[k]);
    return a;
}

template <int D>
HEADRACE_ALWAYS_INLINE std::array<double, D> difference_acceleration(const PressureSums<D, double>& sums, double p_i,
                                                                     const Symmetric<D>& B_i, double rho_i) {
    std::array<double, D> difference;
    for (int k = 0; k < D; ++k) difference[k] = sums.pB_grad[k] - p_i * sums.grad_1[k];
    std::array<double, D> a = B_i * difference;
    for (double& component : a) component *= -1.0 / rho_i;
    return a;
}

}  // namespace headrace::solver
