#include <catch2/catch.hpp>

#include "../plain_sums.h"
#include "server/solver/forces/continuum_surface_force.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

constexpr double kR = 0.7;  // [m]

// Midpoint rule: error O(step^2) = 1e-8 of a smooth integrand.
template <int D>
void check_tension_kernel() {
    const TensionKernel<D> kernel(kR);
    constexpr int kSlices = 20000;
    const double step = kR / kSlices;
    // By parts, the integral of W is that of -W' r/D = -F r^2/D.
    double sum = 0.0;
    bool falls = true;
    for (int k = 0; k < kSlices; ++k) {
        const double r = (k + 0.5) * step;
        const double shell = D == 2 ? 2.0 * std::numbers::pi * r : 4.0 * std::numbers::pi * r * r;
        sum += shell * step * -kernel.F(r * r) * r * r / D;
        falls = falls && kernel.F(r * r) < 0.0;
    }
    CHECK(falls);
    CHECK(sum == Approx(1.0).epsilon(1e-7));
    CHECK(kernel.F(kR * kR) == Approx(0.0).margin(1e-12));
    CHECK(kernel.F(4.0 * kR * kR) == 0.0);
}

}  // namespace

TEST_CASE("ContinuumSurfaceForce.WeightRisesFromNothingToOne") {
    CHECK(surface_weight(0.0) == 0.0);
    CHECK(surface_weight(kNoSurface) == 0.0);
    CHECK(surface_weight(kFullSurface) == 1.0);
    CHECK(surface_weight(3.0) == 1.0);
    CHECK(surface_weight(0.5 * (kNoSurface + kFullSurface)) == Approx(0.5));
    double before = 0.0;
    for (double s = 0.0; s < 0.3; s += 0.01) {
        CHECK(surface_weight(s) >= before);
        before = surface_weight(s);
    }
}

TEST_CASE("ContinuumSurfaceForce.StressLiesAlongTheSurface") {
    const double n_flat = 10.0, inside = 1.0;  // colour: no cohesion
    const std::array<double, 3> n{3.0, -4.0, 12.0};
    const Symmetric<3> S = surface_stress<3>(n, inside, n_flat);
    const std::array<double, 3> across = S * n, along = S * std::array{4.0, 3.0, 0.0};
    for (int k = 0; k < 3; ++k) CHECK(across[k] == Approx(0.0).margin(1e-13));
    // |n| = 13 in the directions across n
    CHECK(along[0] == Approx(13.0 * 4.0));
    CHECK(along[1] == Approx(13.0 * 3.0));
    CHECK(along[2] == Approx(0.0).margin(1e-13));
    // Deep inside and where there is nothing to tell a direction: none.
    CHECK(surface_stress<2>({0.1, 0.2}, inside, n_flat).e == Symmetric<2>{}.e);
    CHECK(surface_stress<2>({0.0, 0.0}, inside, n_flat).e == Symmetric<2>{}.e);
}

TEST_CASE("ContinuumSurfaceForce.WhatSticksOutIsHeldBack") {
    // Cohesion is isotropic and grows with what is missing of the colour.
    const double n_flat = 10.0;
    const Symmetric<2> S = surface_stress<2>({0.0, 0.0}, kCohesiveColour - 0.25, n_flat);
    CHECK(S(0, 0) == Approx(kCohesion * n_flat * 0.25));
    CHECK(S(1, 1) == S(0, 0));
    CHECK(S(0, 1) == 0.0);
    CHECK(surface_stress<2>({0.0, 0.0}, kCohesiveColour, n_flat)(0, 0) == 0.0);
}

TEST_CASE("ContinuumSurfaceForce.TensionKernelIntegratesToOne") {
    check_tension_kernel<2>();
    check_tension_kernel<3>();
}

TEST_CASE("ContinuumSurfaceForce.FlatSurfaceIsTheKernelsPlaneIntegral") {
    const WendlandC2<2> flat(kR);
    const WendlandC2<3> round(kR);
    const FlatSurface of_2 = make_flat_surface<2>([&](double r) { return flat.W(r); }, kR),
                      of_3 = make_flat_surface<3>([&](double r) { return round.W(r); }, kR);
    // 2 int_0^R W dr = 2 N R/3 with int_0^1 (1-s)^4 (1+4s) ds = 1/3; 2 pi int W r dr = 2 pi N R^2/14.
    CHECK(of_2.n == Approx(2.0 * 7.0 / (3.0 * std::numbers::pi * kR)).epsilon(1e-4));
    CHECK(of_3.n == Approx(3.0 / (2.0 * kR)).epsilon(1e-4));
    // With g = 1 and one kernel it would be 3/4; the wider W^t and the threshold of g change little of it.
    CHECK(of_2.C == Approx(0.75).epsilon(0.2));
    CHECK(of_3.C == Approx(0.75).epsilon(0.2));
}
