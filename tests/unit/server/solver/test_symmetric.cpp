#include <catch2/catch.hpp>
#include <random>

#include "server/solver/symmetric.h"

using namespace headrace::solver;

namespace {

// R diag R^T of a rotation about (1,2,2)/3 by an angle (2D: about the origin).
Symmetric<2> rotated(const std::array<double, 2>& diagonal, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    Symmetric<2> m;
    m(0, 0) = c * c * diagonal[0] + s * s * diagonal[1];
    m(0, 1) = c * s * (diagonal[0] - diagonal[1]);
    m(1, 1) = s * s * diagonal[0] + c * c * diagonal[1];
    return m;
}

Symmetric<3> rotated(const std::array<double, 3>& diagonal, double angle) {
    const double n[3] = {1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0}, c = std::cos(angle), s = std::sin(angle);
    const double K[3][3] = {{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}};
    double R[3][3];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) R[i][j] = (i == j ? c : 0.0) + s * K[i][j] + (1.0 - c) * n[i] * n[j];
    }
    Symmetric<3> m;
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            for (int k = 0; k < 3; ++k) m(i, j) += R[i][k] * diagonal[k] * R[j][k];
        }
    }
    return m;
}

template <int D>
void check_inverse(const Symmetric<D>& m) {
    const Symmetric<D> inv = inverse(m);
    for (int i = 0; i < D; ++i) {
        for (int j = 0; j < D; ++j) {
            double sum = 0.0;
            for (int k = 0; k < D; ++k) sum += m(i, k) * inv(k, j);
            CHECK(sum == Approx(i == j ? 1.0 : 0.0).margin(1e-13));
        }
    }
}

}  // namespace

TEST_CASE("Symmetric.InverseAndSmallestEigenvalueOfKnownMatrices") {
    for (const double angle : {0.0, 0.3, 1.2, 2.9}) {
        for (const auto& diagonal : {std::array{1.0, 2.0}, std::array{0.01, 3.0}, std::array{2.0, 2.0}}) {
            const Symmetric<2> m = rotated(diagonal, angle);
            check_inverse(m);
            CHECK(smallest_eigenvalue(m) == Approx(diagonal[0]).epsilon(1e-12));
            CHECK(determinant(m) == Approx(diagonal[0] * diagonal[1]));
        }
        for (const auto& diagonal : {std::array{1.0, 2.0, 3.0}, std::array{0.1, 1.0, 1.0}, std::array{0.5, 0.5, 2.0},
                                     std::array{1.0, 1.0, 1.0}, std::array{0.9, 0.9 + 1e-9, 1.1}}) {
            const Symmetric<3> m = rotated(diagonal, angle);
            check_inverse(m);
            // Two equal roots of a cubic: half the digits are lost.
            CHECK(smallest_eigenvalue(m) == Approx(diagonal[0]).epsilon(1e-7));
            CHECK(determinant(m) == Approx(diagonal[0] * diagonal[1] * diagonal[2]));
        }
    }
    CHECK(smallest_eigenvalue(rotated(std::array{-2.0, 1.0, 3.0}, 0.7)) == Approx(-2.0));
    CHECK(smallest_eigenvalue(Symmetric<3>{}) == 0.0);
    CHECK(smallest_eigenvalue(Symmetric<2>{}) == 0.0);
}

TEST_CASE("Symmetric.IsStoredByRowsOfTheUpperTriangle") {
    Symmetric<3> m;
    m.e = {1, 2, 3, 4, 5, 6};
    CHECK(m(0, 1) == 2.0);
    CHECK(m(1, 0) == 2.0);
    CHECK(m(2, 1) == 5.0);
    CHECK(m(2, 2) == 6.0);
    const std::array<double, 3> product = m * std::array{1.0, 10.0, 100.0};
    CHECK(product == std::array{321.0, 542.0, 653.0});
    CHECK(Symmetric<2>::identity().e == std::array{1.0, 0.0, 1.0});
}
