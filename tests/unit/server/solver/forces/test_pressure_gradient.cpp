#include <catch2/catch.hpp>

#include "../plain_sums.h"
#include "server/solver/forces/gradient_correction.h"
#include "server/solver/forces/pressure_gradient.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

template <int D>
Symmetric<D> scaled_matrix(double factor, const Symmetric<D>& m) {
    Symmetric<D> product;
    for (int k = 0; k < Symmetric<D>::kSize; ++k) product.e[k] = factor * m.e[k];
    return product;
}

}  // namespace

TEST_CASE("PressureGradient.DifferenceFormIsExactForLinearPressure") {
    const Cloud<3> cloud = make_cloud<3>(4, 0.25, 31);
    const std::size_t i = cloud.middle();
    const LinearField<3> p{1e5, {200.0, -300.0, 50.0}};
    Symmetric<3> M;
    PressureSums<3, double> sums;
    cloud.for_each_neighbour(i, [&](std::size_t j, const Pair<3, double>& pair, double F) {
        accumulate_moment<3, double>(pair, F, M);
        accumulate_difference<3, double>(pair.V_j * F, pair.x_ij, p(cloud.x[j]), sums);
    });
    const std::array<double, 3> a = difference_acceleration<3>(sums, p(cloud.x[i]), inverse(M), 800.0);
    // p is 300 times the differences across the support: 1e-16 grows to 1e-12.
    for (int k = 0; k < 3; ++k) CHECK(a[k] == Approx(-p.b[k] / 800.0).epsilon(1e-10));
}

TEST_CASE("PressureGradient.AdjointFormConservesMomentumPairByPair") {
    const std::array<double, 2> x_ij{3.0, -1.0}, x_ji{-3.0, 1.0};  // equal volumes, V F = 1
    Symmetric<2> B_i, B_j;
    B_i.e = {1.1, 0.2, 0.9};
    B_j.e = {0.8, -0.1, 1.3};
    const Symmetric<2> pB_i = scaled_matrix(5.0, B_i), pB_j = scaled_matrix(-2.0, B_j);
    PressureSums<2, double> at_i, at_j;
    accumulate_adjoint<2, double>(1.0, x_ij, pB_j, at_i);
    accumulate_adjoint<2, double>(1.0, x_ji, pB_i, at_j);
    const auto a_i = adjoint_acceleration<2>(at_i, pB_i, 1.0, 1000.0),
               a_j = adjoint_acceleration<2>(at_j, pB_j, 1.0, 1000.0);
    for (int k = 0; k < 2; ++k) CHECK(a_i[k] == Approx(-a_j[k]));
    // by hand: -(p_i B_i + p_j B_j) grad/rho, first row of the matrix (5.5 - 1.6, 1.0 + 0.2)
    CHECK(a_i[0] == Approx(-(3.9 * 3.0 + 1.2 * -1.0) / 1000.0));
}

TEST_CASE("PressureGradient.AdjointFormIsMinusTheTransposeOfTheDivergence") {
    // Power of the pressure forces plus that of compression is 0: sum_i V_i p_i div_i v = sum_i m_i a_i . v_i.
    const Cloud<2> cloud = make_cloud<2>(3, 0.25, 41);
    const std::size_t count = cloud.x.size();
    std::mt19937_64 random(41);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> p(count);
    std::vector<std::array<double, 2>> v(count);
    std::vector<Symmetric<2>> B(count);
    for (std::size_t i = 0; i < count; ++i) {
        p[i] = uniform(random);
        v[i] = {uniform(random), uniform(random)};
        B[i].e = {1.0 + 0.1 * uniform(random), 0.1 * uniform(random), 1.0 + 0.1 * uniform(random)};
    }
    double of_forces = 0.0, of_compression = 0.0, size = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        PressureSums<2, double> sums;
        double divergence = 0.0;
        cloud.for_each_neighbour(i, [&](std::size_t j, const Pair<2, double>& pair, double F) {
            const std::array<double, 2> grad = scaled<2, double>(pair.V_j * F, pair.x_ij);
            accumulate_adjoint<2, double>(pair.V_j * F, pair.x_ij, scaled_matrix(p[j], B[j]), sums);
            const std::array<double, 2> v_ji{v[j][0] - v[i][0], v[j][1] - v[i][1]};
            divergence += dot<2, double>(v_ji, B[i] * grad);
        });
        const auto a = adjoint_acceleration<2>(sums, scaled_matrix(p[i], B[i]), 1.0, 1.0);
        of_forces += cloud.V[i] * dot<2, double>(a, v[i]);
        of_compression += cloud.V[i] * p[i] * divergence;
        size += std::abs(cloud.V[i] * dot<2, double>(a, v[i]));
    }
    CHECK(std::abs(of_forces) > 1e-3 * size);
    CHECK(std::abs(of_forces - of_compression) < 1e-13 * size);
}

TEST_CASE("PressureGradient.TensionControlTurnsTheMeanIntoTheDifference") {
    // p_i = p_j < 0, B = 1: no attraction is left.
    PressureSums<2, double> sums;
    const Symmetric<2> pB = scaled_matrix(-4.0, Symmetric<2>::identity());
    accumulate_adjoint<2, double>(1.0, {1.0, 2.0}, pB, sums);
    CHECK(adjoint_acceleration<2>(sums, pB, -1.0, 10.0) == std::array{0.0, 0.0});
    CHECK(adjoint_acceleration<2>(sums, pB, 1.0, 10.0)[0] == Approx(0.8));
}

TEST_CASE("PressureGradient.TensionIsControlledInsideEvenFluidOnly") {
    const TensionLimits limits{0.9, 0.1};
    CHECK(controls_tension(-1.0, 0.95, 0.05, limits));
    CHECK_FALSE(controls_tension(0.0, 0.95, 0.05, limits));   // no tension
    CHECK_FALSE(controls_tension(-1.0, 0.85, 0.05, limits));  // at a free surface
    CHECK_FALSE(controls_tension(-1.0, 0.95, 0.15, limits));  // beside a crowd, which it would be shot away from
}
