#include <catch2/catch.hpp>

#include "server/solver/boundaries/sphere.h"

using namespace headrace::solver;

namespace {

const SphereBoundary<3> kSphere{{1.0, 0.0, 0.0}, 2.0};

}  // namespace

TEST_CASE("Sphere.FIsTheImplicitFunction") {
    CHECK(kSphere.F({1.0, 0.0, 0.0}) == Approx(-4.0));
    CHECK(kSphere.F({1.0, 2.0, 0.0}) == 0.0);
    CHECK(kSphere.F({1.0, 3.0, 0.0}) == Approx(5.0));
}

TEST_CASE("Sphere.ContainerContactPointsInward") {
    const Contact<3> contact = kSphere.contact({1.0, 1.8, 2.4});  // distance 3
    CHECK(contact.cp[1] == Approx(1.2));
    CHECK(contact.cp[2] == Approx(1.6));
    CHECK(contact.d == Approx(1.0));
    CHECK(contact.n[0] == 0.0);
    CHECK(contact.n[1] == Approx(-0.6));
    CHECK(contact.n[2] == Approx(-0.8));
}

TEST_CASE("Sphere.ObstacleContactPointsOutward") {
    const Contact<3> contact = kSphere.contact({1.0, -0.6, 0.8});  // distance 1
    CHECK(contact.cp[1] == Approx(-1.2));
    CHECK(contact.cp[2] == Approx(1.6));
    CHECK(contact.d == Approx(1.0));
    CHECK(contact.n[1] == Approx(-0.6));
    CHECK(contact.n[2] == Approx(0.8));
}

TEST_CASE("Sphere.DiscIn2D") {
    const SphereBoundary<2> disc{{0.0, 0.0}, 1.0};
    const Contact<2> contact = disc.contact({0.3, 0.4});
    CHECK(contact.cp[0] == Approx(0.6));
    CHECK(contact.cp[1] == Approx(0.8));
    CHECK(contact.n[0] == Approx(0.6));
    CHECK(contact.d == Approx(0.5));
}

TEST_CASE("Sphere.ParticleInTheCentreLeavesUpward") {
    const Contact<3> contact = kSphere.contact({1.0, 0.0, 0.0});
    CHECK(contact.cp == Point<3>{1.0, 2.0, 0.0});
    CHECK(contact.n == Point<3>{0.0, 1.0, 0.0});
    CHECK(contact.d == 2.0);
}
