#include <catch2/catch.hpp>

#include "server/solver/boundaries/collider.h"

using namespace headrace::solver;

namespace {

const CollisionObject kTank{"tank", Role::container, Box{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}};
const CollisionObject kPanel{"panel", Role::obstacle, Box{{0.305, 0.5, 0.5}, {0.005, 0.7, 0.7}}};

struct Outcome {
    Point<3> x, v;
};

Outcome collide(const std::vector<CollisionObject>& objects, const Point<3>& x0, const Point<3>& x,
                const Point<3>& v = {1.0, 1.0, 1.0}) {
    Outcome outcome{x, v};
    Collider<3>(objects, 0.0, 0.01).apply(x0, outcome.x, outcome.v);
    return outcome;
}

}  // namespace

TEST_CASE("Collider.WithoutObjectsIsEmpty") {
    CHECK(Collider<3>({}, 0.0, 0.01).is_empty());
    CHECK_FALSE(Collider<3>(std::vector<CollisionObject>{kPanel}, 0.0, 0.01).is_empty());
}

TEST_CASE("Collider.FreeParticleIsLeftAlone") {
    const Outcome outcome = collide({kTank, kPanel}, {0.1, 0.1, 0.1}, {0.2, 0.2, 0.2});
    CHECK(outcome.x == Point<3>{0.2, 0.2, 0.2});
    CHECK(outcome.v == Point<3>{1.0, 1.0, 1.0});
}

TEST_CASE("Collider.PanelHoldsBesideTheFloorInEitherOrder") {
    // The path runs below the floor and through the panel: it must not come up on the other side.
    for (const auto& objects : {std::vector<CollisionObject>{kTank, kPanel}, {kPanel, kTank}}) {
        const Outcome outcome = collide(objects, {0.29, 0.001, 0.5}, {0.35, -0.9, 0.5});
        CHECK(outcome.x[0] == 0.305 - 0.005);
        CHECK(outcome.x[1] == 0.0);
    }
}

TEST_CASE("Collider.ContainersWinOverObstacles") {
    // An obstacle reaching to the wall pushes through it; the tank keeps the particle.
    const CollisionObject ball{"ball", Role::obstacle, Sphere{{0.9, 0.5, 0.5}, 0.3}};
    for (const auto& objects : {std::vector<CollisionObject>{kTank, ball}, {ball, kTank}}) {
        const Outcome outcome = collide(objects, {0.99, 0.9, 0.5}, {0.99, 0.5, 0.5});
        CHECK(outcome.x[0] == 1.0);
    }
    const CollisionObject bowl{"bowl", Role::container, Sphere{{0.5, 0.5, 0.5}, 0.5}};
    const Outcome outcome = collide({bowl, ball}, {0.5, 0.5, 0.5}, {0.95, 0.55, 0.5});
    double r2 = 0.0;
    for (int k = 0; k < 3; ++k) r2 += (outcome.x[k] - 0.5) * (outcome.x[k] - 0.5);
    CHECK(std::sqrt(r2) <= 0.5 * (1 + 1e-15));
}

TEST_CASE("Collider.BoxesComeBeforeSpheres") {
    // Box first: (1.2, 0.5) -> x = 1; then the disc of radius 0.4 about the middle brings it to x = 0.9.
    const CollisionObject disc{"disc", Role::container, Sphere{{0.5, 0.5, 0.5}, 0.4}};
    const Outcome outcome = collide({disc, kTank}, {0.5, 0.5, 0.5}, {1.2, 0.5, 0.5});
    CHECK(outcome.x[0] == Approx(0.9));
}

TEST_CASE("Collider.PanelPutOntoAParticleFreesItInsideTheTank") {
    // Nearest face of the tall panel would be below the floor.
    const CollisionObject wide{"wide", Role::obstacle, Box{{0.5, 0.5, 0.5}, {0.2, 0.51, 0.6}}};
    const Outcome outcome = collide({kTank, wide}, {0.6, 0.01, 0.5}, {0.6, 0.0, 0.5});
    CHECK(outcome.x[0] == 0.5 + 0.2);
    CHECK(outcome.x[1] == 0.0);
}

TEST_CASE("Collider.FlatSceneIgnoresTheThirdAxis") {
    const std::vector<CollisionObject> objects{{"tank", Role::container, Box{{0.5, 0.5, 9.0}, {0.5, 0.5, 0.0}}}};
    Point<2> x{1.2, 0.5}, v{1.0, 2.0};
    Collider<2>(objects, 0.0, 0.01).apply({0.9, 0.5}, x, v);
    CHECK(x == Point<2>{1.0, 0.5});
    CHECK(v == Point<2>{0.0, 2.0});
}
