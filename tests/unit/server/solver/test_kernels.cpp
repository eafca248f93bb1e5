#include <catch2/catch.hpp>
#include <numbers>

#include "server/solver/kernels.h"

using namespace headrace::solver;

namespace {

// Integral of f(r) over a ball (disc) of radius R: midpoint rule on shells, error O(1/n^2).
template <int D, class F>
double integrate(double R, F&& f) {
    constexpr int n = 20000;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        const double r = (i + 0.5) * R / n;
        sum += f(r) * (D == 3 ? 4.0 * std::numbers::pi * r * r : 2.0 * std::numbers::pi * r) * (R / n);
    }
    return sum;
}

// Central differences of W(r), step small against h; error e^2/6 W''' ~ 1e-6 of W/h.
template <int D, class F>
void check_derivatives(F&& W, double r, double h, double gradient_factor, double laplacian) {
    const double e = 1e-4 * h;
    const double first = (W(r + e) - W(r - e)) / (2.0 * e);
    const double second = (W(r + e) - 2.0 * W(r) + W(r - e)) / (e * e);
    // 1e-5: of the largest slope and curvature a kernel of this width has
    CHECK(gradient_factor * r == Approx(first).margin(1e-5 * W(0.1 * h) / h));
    CHECK(laplacian == Approx(second + (D - 1) / r * first).margin(1e-5 * W(0.1 * h) / (h * h)).epsilon(1e-5));
}

template <int D>
void check_normalised(double h) {
    // 1e-6: the midpoint rule on 20,000 shells; the viscosity kernel's pole (logarithm) at 0 is integrable
    CHECK(integrate<D>(h, [&](double r) { return Poly6<D>(h).W(r * r); }) == Approx(1.0).epsilon(1e-6));
    CHECK(integrate<D>(h, [&](double r) { return Spiky<D>(h).W(r); }) == Approx(1.0).epsilon(1e-6));
    CHECK(integrate<D>(h, [&](double r) { return ViscosityKernel<D>(h).W(r); }) == Approx(1.0).epsilon(1e-6));
    CHECK(integrate<D>(9.0 * h, [&](double r) { return IsotropicGaussian<D>(h).W(r * r); }) ==
          Approx(1.0).epsilon(1e-6));
}

template <int D>
void check_all_derivatives(double h) {
    const Poly6<D> poly6(h);
    const Spiky<D> spiky(h);
    const ViscosityKernel<D> viscosity(h);
    const IsotropicGaussian<D> gaussian(h);
    for (const double q : {0.2, 0.45, 0.7, 0.9}) {
        const double r = q * h;
        INFO("D = " << D << ", r/h = " << q);
        check_derivatives<D>([&](double s) { return poly6.W(s * s); }, r, h, poly6.gradient_factor(r * r),
                             poly6.laplacian(r * r));
        check_derivatives<D>([&](double s) { return spiky.W(s); }, r, h, spiky.gradient_factor(r, 1.0 / r),
                             spiky.laplacian(r));
        check_derivatives<D>([&](double s) { return viscosity.W(s); }, r, h, viscosity.gradient_factor(r),
                             viscosity.laplacian(r));
        check_derivatives<D>([&](double s) { return gaussian.W(s * s); }, r, h, gaussian.gradient_factor(r * r),
                             gaussian.laplacian(r * r));
    }
}

}  // namespace

TEST_CASE("Kernels.IntegrateToOne") {
    check_normalised<2>(0.0457);
    check_normalised<3>(0.0457);
    check_normalised<3>(2.0);
}

TEST_CASE("Kernels.DerivativesMatchFiniteDifferences") {
    check_all_derivatives<2>(0.0457);
    check_all_derivatives<3>(0.0457);
}

TEST_CASE("Kernels.EndAtTheSupportRadius") {
    const double h = 0.5;
    CHECK(Poly6<3>(h).W(h * h) == 0.0);
    CHECK(Poly6<3>(h).gradient_factor(1.1 * h * h) == 0.0);
    CHECK(Poly6<3>(h).laplacian(1.1 * h * h) == 0.0);
    CHECK(Spiky<3>(h).slope(1.1 * h) == 0.0);
    CHECK(ViscosityKernel<3>(h).laplacian(1.1 * h) == 0.0);
    CHECK(ViscosityKernel<3>(h).W(1.1 * h) == 0.0);
}

TEST_CASE("Kernels.HaveTheThesisConstantsIn3D") {
    const double h = 0.7, pi = std::numbers::pi;
    CHECK(Poly6<3>(h).W(0.0) == Approx(315.0 / (64.0 * pi * h * h * h)).epsilon(1e-14));
    CHECK(Poly6<3>(h).gradient_factor(0.0) == Approx(-945.0 / (32.0 * pi * std::pow(h, 5))).epsilon(1e-14));
    CHECK(Spiky<3>(h).slope(0.0) == Approx(-45.0 / (pi * std::pow(h, 4))).epsilon(1e-14));
    CHECK(ViscosityKernel<3>(h).laplacian(0.0) == Approx(45.0 / (pi * std::pow(h, 5))).epsilon(1e-14));
}

TEST_CASE("Kernels.SpikyHasNoForceWithoutDirection") {
    CHECK(Spiky<3>(0.1).gradient_factor(0.0, 0.0) == 0.0);
}
