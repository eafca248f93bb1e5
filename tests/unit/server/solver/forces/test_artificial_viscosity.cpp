#include <catch2/catch.hpp>

#include "../plain_sums.h"
#include "server/solver/forces/artificial_viscosity.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

TEST_CASE("ArtificialViscosity.OnePairByHand") {
    // approach v_ij . x_ij/r^2 = (-1 * 0.3 + 2 * 0.4)/0.25 = 2
    const Pair<2, double> pair{{0.3, 0.4}, 0.25, 0.5, 0.1};
    CHECK(approach_rate<2, double>(pair, {-1.0, 2.0}, {}) == Approx(2.0));
    // What the mean strain rate explains is left out: x . S x/r^2 = (2 * 0.09 + 2 * 3 * 0.12 + 1 * 0.16)/0.25
    Symmetric<2> S;  // the mean of both ends
    S(0, 0) = 2.0;
    S(0, 1) = 3.0;
    S(1, 1) = 1.0;
    CHECK(approach_rate<2, double>(pair, {-1.0, 2.0}, S) == Approx(2.0 - 1.06 / 0.25));
}

TEST_CASE("ArtificialViscosity.SeesAnApproachAndBothEndsAlike") {
    const Pair<3, double> pair{{0.1, 0.2, 0.2}, 0.09, 0.3, 1.0}, back{{-0.1, -0.2, -0.2}, 0.09, 0.3, 1.0};
    Symmetric<3> S;
    S.e = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    const std::array<double, 3> v{-1.0, -1.0, 0.5}, minus_v{1.0, 1.0, -0.5};
    // The rate is the same for both ends; x_ij changes sign, so momentum is kept.
    CHECK(approach_rate<3, double>(pair, v, S) == approach_rate<3, double>(back, minus_v, S));
    CHECK(approach_rate<3, double>(pair, v, {}) < 0.0);
}

TEST_CASE("ArtificialViscosity.ReconstructedSparesALinearVelocity") {
    // v = G x: with S the symmetric part of G nothing is left, rotation included.
    const std::array<std::array<double, 2>, 2> G{{{1.0, 3.0}, {-2.0, -1.0}}};
    Symmetric<2> S;
    S(0, 0) = 1.0;
    S(0, 1) = 0.5;
    S(1, 1) = -1.0;
    const Cloud<2> cloud = make_cloud<2>(3, 0.3, 3);
    cloud.for_each_neighbour(cloud.middle(), [&](std::size_t, const Pair<2, double>& pair, double) {
        std::array<double, 2> v_ij{};
        for (int k = 0; k < 2; ++k) v_ij[k] = dot<2, double>(G[k], pair.x_ij);
        CHECK(std::abs(approach_rate<2, double>(pair, v_ij, S)) < 1e-13);
    });
}

TEST_CASE("ArtificialViscosity.IsZeroForCoincidentParticles") {
    const Pair<2, double> pair{{0.0, 0.0}, squared_distance<2, double>({0.0, 0.0}), 0.0, 1.0};
    CHECK(approach_rate<2, double>(pair, {1.0, 1.0}, {}) == 0.0);
}
