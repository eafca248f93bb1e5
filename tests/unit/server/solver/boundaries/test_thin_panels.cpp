// Thin panels: fluid on both sides, each seeing its own wall.
#include <cstdio>
#include <random>

#include "wall_checks.h"

using namespace headrace::solver;

namespace {

const Domain kWide{{-1.0, -1.0, -1.0}, {3.0, 3.0, 3.0}, {}};

// A tank full of fluid with panels in it: is every particle's support filled once?
double worst_in_tank(int dimensions, const std::vector<Box>& panels, const Vec3& max, bool tank_first = true) {
    std::vector<CollisionObject> objects;
    for (const Box& panel : panels) objects.push_back(wall(panel));
    const CollisionObject tank = wall(box_between({}, max), Role::container);
    objects.insert(tank_first ? objects.begin() : objects.end(), tank);
    const Walls walls = make_walls(dimensions, objects, kWide);
    REQUIRE(walls.has_thin());
    const auto fluid =
        fluid_lattice(dimensions, {}, max, [&](const Vec3& x) { return walls.distance_to_any(x) > 0.0; });
    return worst_sum_error(walls, kWide, fluid, fluid);
}

}  // namespace

TEST_CASE("ThinPanel.FreeStandingPanelFillsEverySupportOnce") {
    // Two spacings thick with a gap all around: faces, rims and corners. Then a bare sheet of no thickness, whose rim
    // is a line.
    const double thickness = GENERATE(0.0, 0.1, 0.2, 0.5);
    const Box panel = box_between({0.8, 0.4, 0.4}, {0.8 + thickness, 1.2, 1.0});
    CHECK(worst_in_tank(2, {panel}, {1.8, 1.6, 0.0}) < kRoundOff);
}

TEST_CASE("ThinPanel.FreeStandingPanelFillsEverySupportOnceIn3D") {
    const double thickness = GENERATE(0.0, 0.2);
    const Box panel = box_between({0.4, 0.4, 0.4}, {0.4 + thickness, 0.7, 0.8});
    CHECK(worst_in_tank(3, {panel}, {1.0, 1.0, 1.1}) < kRoundOff);
}

TEST_CASE("ThinPanel.PillarThinAlongBothAxesFillsEverySupportOnce") {
    CHECK(worst_in_tank(2, {box_between({0.5, 0.5, 0.0}, {0.7, 0.8, 0.0})}, {1.2, 1.3, 0.0}) < kRoundOff);
}

TEST_CASE("ThinPanel.PanelThroughTheFloorEndsAtTheTank") {
    const bool tank_first = GENERATE(true, false);
    // Stands in the floor and goes out through the ceiling: divides the tank.
    CHECK(worst_in_tank(2, {box_between({0.6, -0.4, 0.0}, {0.8, 1.7, 0.0})}, {1.4, 1.2, 0.0}, tank_first) < kRoundOff);
    // Ends exactly on the floor.
    CHECK(worst_in_tank(2, {box_between({0.6, 0.0, 0.0}, {0.7, 0.8, 0.0})}, {1.4, 1.2, 0.0}, tank_first) < kRoundOff);
}

TEST_CASE("ThinPanel.TwoPanelsThatMeetFillEverySupportOnce") {
    // An L, and a cross.
    CHECK(worst_in_tank(2,
                        {box_between({0.6, 0.4, 0.0}, {0.7, 1.2, 0.0}), box_between({0.6, 0.4, 0.0}, {1.2, 0.5, 0.0})},
                        {1.8, 1.6, 0.0}) < kRoundOff);
    CHECK(worst_in_tank(2,
                        {box_between({0.8, 0.3, 0.0}, {0.9, 1.3, 0.0}), box_between({0.3, 0.8, 0.0}, {1.4, 0.9, 0.0})},
                        {1.7, 1.6, 0.0}) < kRoundOff);
}

TEST_CASE("ThinPanel.TurnedPanelFillsEverySupportOnce") {
    // A lattice of fluid turned together with the panel: the same picture seen from another frame.
    CollisionObject panel = wall(box_between({-0.1, -0.4, 0.0}, {0.1, 0.4, 0.0}));
    RigidState turned;
    const double c = std::cos(0.7), s = std::sin(0.7);
    turned.rotation = {c, -s, 0, s, c, 0, 0, 0, 1};
    turned.translation = {0.3, 0.2, 0.0};
    panel.motion = [turned](double) { return turned; };
    const Walls walls = make_walls(2, {panel}, kWide);
    std::vector<Vec3> fluid, inner;
    for (const Vec3& X : fluid_lattice(2, {-0.8, -1.0, 0.0}, {0.8, 1.0, 0.0}, [](const Vec3&) { return true; })) {
        const Vec3 x = rigid::to_world(turned, X);
        if (walls.distance(0, x) <= 0.0) continue;
        fluid.push_back(x);
        if (std::abs(X[0]) < 0.5 && std::abs(X[1]) < 0.7) inner.push_back(x);
    }
    CHECK(worst_sum_error(walls, kWide, fluid, inner) < kRoundOff);
}

TEST_CASE("ThinPanel.PanelThinnerThanTheSpacingKeepsTheSumNearOne") {
    // 0.3 spacings thick: each side's lattice begins at its own face. Along the faces the sum must be exact.
    const Box panel = box_between({0.8, -0.4, 0.0}, {0.83, 1.2, 0.0});
    const Walls walls = make_walls(2, {wall(box_between({}, {1.63, 1.6, 0.0}), Role::container), wall(panel)}, kWide);
    auto fluid = fluid_lattice(2, {}, {0.8, 1.6, 0.0}, [](const Vec3&) { return true; });
    for (const Vec3& x : fluid_lattice(2, {0.83, 0.0, 0.0}, {1.63, 1.6, 0.0}, [](const Vec3&) { return true; })) {
        fluid.push_back(x);
    }
    std::vector<Vec3> along, rim;
    for (const Vec3& x : fluid) {
        const double from_panel = std::min(std::abs(x[0] - 0.8), std::abs(x[0] - 0.83));
        if (from_panel < 0.1 && x[1] < 0.9 && x[1] > 0.3) along.push_back(x);
        if (from_panel < 0.1 && x[1] >= 0.9 && x[1] < 1.3) rim.push_back(x);
    }
    CHECK(worst_sum_error(walls, kWide, fluid, along) < kRoundOff);
    // At and above the rim the gap of 0.3 spacings between the two lattices of fluid is seen, which is empty: it lacks
    // at most its width times the kernel's integral along a line through its middle, 14/(3 pi R).
    const double gap = 0.03 * 14.0 / (3.0 * std::numbers::pi * kSupport);
    CHECK(worst_sum_error(walls, kWide, fluid, rim) < gap);
}

TEST_CASE("ThinPanel.SidesAreSeparate") {
    const Walls walls = make_walls(2, {wall(box_between({0.0, 0.0, 0.0}, {0.2, 1.0, 0.0}))}, kWide);
    CHECK(walls.is_blocked({-0.05, 0.5, 0.0}, {0.25, 0.5, 0.0}));
    CHECK(walls.is_blocked({-0.05, 0.95, 0.0}, {0.25, 0.95, 0.0}));
    CHECK(!walls.is_blocked({-0.05, 0.5, 0.0}, {-0.05, 0.7, 0.0}));
    CHECK(!walls.is_blocked({-0.05, 1.05, 0.0}, {0.25, 1.05, 0.0}));  // over the rim
    CHECK(!walls.is_blocked({0.0, 0.4, 0.0}, {0.0, 0.6, 0.0}));       // sliding along the face
    CHECK(!walls.is_blocked({0.0, 0.4, 0.0}, {-0.1, 0.5, 0.0}));      // off the face
    CHECK(walls.is_blocked({0.0, 0.4, 0.0}, {0.2, 0.4, 0.0}));        // from face to face
    // A little inside still belongs to its side.
    CHECK(!walls.is_blocked({0.01, 0.5, 0.0}, {-0.1, 0.5, 0.0}));
    CHECK(walls.is_blocked({0.01, 0.5, 0.0}, {0.25, 0.5, 0.0}));
    CHECK(walls.is_blocked({0.01, 0.5, 0.0}, {0.19, 0.5, 0.0}));

    const WallParticles& particles = walls.particles();
    int from_left = 0, from_right = 0, from_both = 0;
    for (std::size_t k = 0; k < particles.size(); ++k) {
        REQUIRE(particles.sheet[k] != 0);
        const bool left = walls.sees({-0.05, 0.5, 0.0}, k), right = walls.sees({0.25, 0.5, 0.0}, k);
        if (left) {
            REQUIRE(particles.x[0][k] > 0.0);
            REQUIRE(particles.n[0][k] < 0.0);
        }
        // Inside the box by a little: the same side.
        if (left && particles.x[1][k] > 0.3 && particles.x[1][k] < 0.7) REQUIRE(walls.sees({0.01, 0.5, 0.0}, k));
        from_left += left;
        from_right += right;
        from_both += left && right;
    }
    CHECK(from_left > 20);
    CHECK(from_left == from_right);
    CHECK(from_both == 0);
}

TEST_CASE("ThinPanel.NearnessCoversEveryPairThatNeedsTheTests") {
    const unsigned seed = 20120711;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> somewhere(-1.2, 1.8);
    const Walls walls = make_walls(2, {wall(box_between({0.0, 0.0, 0.0}, {0.1, 0.6, 0.0}))}, kWide);
    const WallParticles& particles = walls.particles();
    int blocked = 0, unseen = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        const Vec3 a{somewhere(random), somewhere(random), 0.0};
        const Vec3 b{a[0] + 0.2 * somewhere(random), a[1] + 0.2 * somewhere(random), 0.0};
        if (rigid::length(rigid::minus(a, b)) < kSupport && walls.is_blocked(a, b)) {
            ++blocked;
            REQUIRE(walls.is_near_thin(a, 0.0));
        }
        for (std::size_t k = trial % 7; k < particles.size(); k += 7) {
            if (rigid::length(rigid::minus(a, position_of(particles, k))) >= kSupport || walls.sees(a, k)) continue;
            ++unseen;
            REQUIRE(walls.is_near_thin(a, 0.0));
        }
    }
    CHECK(blocked > 20);
    CHECK(unseen > 20);
    CHECK(!walls.is_near_thin({2.0, 0.3, 0.0}, 0.5));
    CHECK(walls.is_near_thin({2.0, 0.3, 0.0}, 1.4));
}

TEST_CASE("ThinPanel.PeriodicPanelSeparatesAcrossTheSeam") {
    const Domain domain{{0.0, 0.0, 0.0}, {1.6, 1.2, 0.0}, {true, true, false}};
    // Across the seam of x; endless along y.
    const Walls walls = make_walls(2, {wall(box_between({1.5, 0.0, 0.0}, {1.7, 1.2, 0.0}))}, domain);
    REQUIRE(walls.has_thin());
    CHECK(walls.is_blocked({1.45, 0.3, 0.0}, {0.15, 0.3, 0.0}));
    CHECK(walls.is_blocked({0.15, 1.15, 0.0}, {1.45, 0.05, 0.0}));
    CHECK(!walls.is_blocked({0.15, 1.15, 0.0}, {0.15, 0.05, 0.0}));
    const auto fluid =
        fluid_lattice(2, domain.min, domain.max, [&](const Vec3& x) { return walls.distance_to_any(x) > 0.0; });
    REQUIRE(fluid.size() == 14 * 12);
    CHECK(worst_sum_error(walls, domain, fluid, fluid) < kRoundOff);
}
