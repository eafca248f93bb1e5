#include <catch2/catch.hpp>

#include "../plain_sums.h"
#include "server/solver/forces/continuum_surface_force.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

TEST_CASE("ContinuumSurfaceForce.DirectionIsAUnitNormalOrNothing") {
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
    const double n_flat = 10.0;
    CHECK(surface_direction<2>({0.1, 0.2}, n_flat) == std::array{0.0, 0.0});
    CHECK(surface_direction<2>({0.0, 0.0}, n_flat) == std::array{0.0, 0.0});
    const std::array<double, 2> q = surface_direction<2>({3.0, -4.0}, n_flat);
    CHECK(q[0] == Approx(0.6));
    CHECK(q[1] == Approx(-0.8));
}

TEST_CASE("ContinuumSurfaceForce.HessianIsTheDerivativeOfTheGradient") {
    const WendlandC2<3> kernel(0.4);
    const std::array<double, 3> x{0.1, -0.05, 0.12}, u{0.3, 2.0, -1.0};
    const auto pair_at = [](const std::array<double, 3>& at) {
        const double r2 = dot<3, double>(at, at);
        return Pair<3, double>{at, r2, std::sqrt(r2), 1.0};
    };
    std::array<double, 3> sum{};
    const Pair<3, double> pair = pair_at(x);
    accumulate_hessian<3, double>(pair, kernel.F(pair.r), kernel.dF_dr(pair.r), u, sum);
    // Central difference along u of grad W = F x: error O(step^2).
    constexpr double kStep = 1e-5;
    std::array<double, 3> ahead = x, behind = x;
    for (int k = 0; k < 3; ++k) {
        ahead[k] += kStep * u[k];
        behind[k] -= kStep * u[k];
    }
    for (int k = 0; k < 3; ++k) {
        const double slope =
            (kernel.F(pair_at(ahead).r) * ahead[k] - kernel.F(pair_at(behind).r) * behind[k]) / (2.0 * kStep);
        CHECK(sum[k] == Approx(slope).epsilon(1e-6));
    }
    // Antisymmetric: the partner has -x_ij and -u, and takes what this one gets.
    std::array<double, 3> both = sum;
    accumulate_hessian<3, double>(pair_at({-x[0], -x[1], -x[2]}), kernel.F(pair.r), kernel.dF_dr(pair.r),
                                  {-u[0], -u[1], -u[2]}, both);
    for (int k = 0; k < 3; ++k) CHECK(both[k] == 0.0);
    std::array<double, 3> coincident{};
    accumulate_hessian<3, double>(pair_at({0, 0, 0}), kernel.F(0.0), kernel.dF_dr(0.0), u, coincident);
    CHECK(coincident[1] == Approx(kernel.F(0.0) * u[1]));
}

TEST_CASE("ContinuumSurfaceForce.FlatSurfaceIsTheKernelsPlaneIntegral") {
    constexpr double kR = 0.7;
    const WendlandC2<2> flat(kR);
    const WendlandC2<3> round(kR);
    const FlatSurface of_2 = make_flat_surface<2>([&](double r) { return flat.W(r); }, kR),
                      of_3 = make_flat_surface<3>([&](double r) { return round.W(r); }, kR);
    // 2 int_0^R W dr = 2 N R/3 with int_0^1 (1-s)^4 (1+4s) ds = 1/3; 2 pi int W r dr = 2 pi N R^2/14.
    CHECK(of_2.n == Approx(2.0 * 7.0 / (3.0 * std::numbers::pi * kR)).epsilon(1e-4));
    CHECK(of_3.n == Approx(3.0 / (2.0 * kR)).epsilon(1e-4));
    // Little is lost to the threshold, and never more than all.
    for (const double C : {of_2.C, of_3.C}) {
        CHECK(C < 1.0);
        CHECK(C > 0.7);
    }
}
