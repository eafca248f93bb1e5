#include <catch2/catch.hpp>

#include "server/solver/boundaries/response.h"

using namespace headrace::solver;

TEST_CASE("Response.WithoutRestitutionTheNormalVelocityGoes") {
    Point<3> x{0.0, -0.1, 0.0}, v{1.0, -2.0, 3.0};
    apply_response<3>({{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.1}, 0.0, 0.01, x, v);
    CHECK(x == Point<3>{0.0, 0.0, 0.0});
    CHECK(v == Point<3>{1.0, 0.0, 3.0});
}

TEST_CASE("Response.RestitutionGivesBackTheShareOfTheDepth") {
    Point<2> x{0.0, -0.02}, v{3.0, -4.0};
    apply_response<2>({{0.0, 0.0}, {0.0, 1.0}, 0.02}, 0.5, 0.01, x, v);
    // factor 1 + 0.5 * 0.02 / (0.01 * 5) = 1.2
    CHECK(v[0] == 3.0);
    CHECK(v[1] == Approx(-4.0 + 1.2 * 4.0));
}

TEST_CASE("Response.ObliqueNormal") {
    Point<2> x{}, v{1.0, 0.0};
    apply_response<2>({{}, {0.6, 0.8}, 0.0}, 1.0, 0.01, x, v);
    CHECK(v[0] == Approx(1.0 - 0.36));
    CHECK(v[1] == Approx(-0.48));
}

TEST_CASE("Response.SticksAsInTheThesis") {
    // v.n is removed even where the particle already moves back.
    Point<2> x{0.0, -0.1}, v{0.0, 2.0};
    apply_response<2>({{0.0, 0.0}, {0.0, 1.0}, 0.1}, 0.0, 0.01, x, v);
    CHECK(v[1] == 0.0);
}

TEST_CASE("Response.ParticleAtRestStaysAtRest") {
    Point<3> x{0.0, -0.1, 0.0}, v{};
    apply_response<3>({{}, {0.0, 1.0, 0.0}, 0.1}, 1.0, 0.01, x, v);
    CHECK(x == Point<3>{});
    CHECK(v == Point<3>{});
}
