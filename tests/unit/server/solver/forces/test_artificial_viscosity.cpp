#include <catch2/catch.hpp>

#include "../plain_sums.h"
#include "server/solver/forces/artificial_viscosity.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

TEST_CASE("ArtificialViscosity.OnePairByHand") {
    // approach v_ij . x_ij/r^2 = (-1 * 0.3 + 2 * 0.4)/0.25 = 2
    const Pair<2, double> pair{{0.3, 0.4}, 0.25, 0.5, 0.1};
    CHECK(approach_factor<2, double>(pair, -7.0, {-1.0, 2.0}, {}) == Approx(0.1 * -7.0 * 2.0));
    // What the mean strain rate explains is left out: x . S x/r^2 = (2 * 0.09 + 2 * 3 * 0.12 + 1 * 0.16)/0.25
    Symmetric<2> S;
    S(0, 0) = 2.0;
    S(0, 1) = 3.0;
    S(1, 1) = 1.0;
    CHECK(approach_factor<2, double>(pair, -7.0, {-1.0, 2.0}, S) == Approx(0.1 * -7.0 * (2.0 - 1.06 / 0.25)));
}

TEST_CASE("ArtificialViscosity.RepelsWhatApproachesAndBothAlike") {
    const Pair<3, double> pair{{0.1, 0.2, 0.2}, 0.09, 0.3, 1.0}, back{{-0.1, -0.2, -0.2}, 0.09, 0.3, 1.0};
    Symmetric<3> S;
    S.e = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    const std::array<double, 3> v{-1.0, -1.0, 0.5}, minus_v{1.0, 1.0, -0.5};
    // The factor is the same for both ends; x_ij changes sign, so momentum is kept.
    CHECK(approach_factor<3, double>(pair, -2.0, v, S) == approach_factor<3, double>(back, -2.0, minus_v, S));
    CHECK(approach_factor<3, double>(pair, -2.0, v, {}) > 0.0);  // along x_ij: apart
}

TEST_CASE("ArtificialViscosity.ReconstructedSparesALinearVelocity") {
    // v = G x: with S the symmetric part of G nothing is left, rotation included.
    const std::array<std::array<double, 2>, 2> G{{{1.0, 3.0}, {-2.0, -1.0}}};
    Symmetric<2> S;
    S(0, 0) = 1.0;
    S(0, 1) = 0.5;
    S(1, 1) = -1.0;
    const Cloud<2> cloud = make_cloud<2>(3, 0.3, 3);
    cloud.for_each_neighbour(cloud.middle(), [&](std::size_t, const Pair<2, double>& pair, double F) {
        std::array<double, 2> v_ij{};
        for (int k = 0; k < 2; ++k) v_ij[k] = dot<2, double>(G[k], pair.x_ij);
        CHECK(std::abs(approach_factor<2, double>(pair, F, v_ij, S)) < 1e-14);
    });
}

TEST_CASE("ArtificialViscosity.IsFiniteForCoincidentParticles") {
    const Pair<2, double> pair{{0.0, 0.0}, 0.0, 0.0, 1.0};
    CHECK(approach_factor<2, double>(pair, -5.0, {1.0, 1.0}, {}) == 0.0);
}
