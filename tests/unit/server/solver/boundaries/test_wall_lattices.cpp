// Flat walls continue the fluid's lattice: nothing tells a particle at a wall, an edge or a corner from one inside.
#include <algorithm>

#include "wall_checks.h"

using namespace headrace::solver;

namespace {

const Domain kWide{{-1.0, -1.0, -1.0}, {2.0, 2.0, 2.0}, {}};

bool anywhere(const Vec3&) {
    return true;
}

}  // namespace

TEST_CASE("Walls.BoxContainerContinuesTheLatticeAtFacesEdgesAndCorners") {
    const int dimensions = GENERATE(2, 3);
    const Vec3 min{0.0, 0.0, 0.0}, max{0.8, 0.7, 0.6};
    const Walls walls = make_walls(dimensions, {wall(box_between(min, max), Role::container)}, kWide);
    const auto fluid = fluid_lattice(dimensions, min, max, anywhere);
    CHECK(worst_sum_error(walls, kWide, fluid, fluid) < kRoundOff);
}

TEST_CASE("Walls.BoxObstacleContinuesTheLatticeAroundIt") {
    const int dimensions = GENERATE(2, 3);
    const Vec3 min{0.0, 0.0, 0.0}, max{1.3, 1.3, 1.3};
    const Vec3 low{0.3, 0.3, 0.3}, high{1.0, 0.9, 0.9};
    // Inside a tank, so that the fluid around it is complete.
    const Walls walls =
        make_walls(dimensions, {wall(box_between(min, max), Role::container), wall(box_between(low, high))}, kWide);
    REQUIRE(!walls.has_thin());
    const auto fluid = fluid_lattice(dimensions, min, max, [&](const Vec3& x) { return walls.distance(1, x) > 0.0; });
    CHECK(worst_sum_error(walls, kWide, fluid, fluid) < kRoundOff);
}

TEST_CASE("Walls.ObstacleOnTheFloorAndInTheWallSharesTheSolid") {
    const int dimensions = GENERATE(2, 3);
    const int first = GENERATE(0, 1);
    const Vec3 min{0.0, 0.0, 0.0}, max{1.2, 1.2, 0.8};
    const CollisionObject tank = wall(box_between(min, max), Role::container);
    // Stands on the floor, sticks into the wall at x = max and goes on beyond the tank.
    const CollisionObject step = wall(box_between({0.5, 0.0, -0.3}, {1.9, 0.6, 1.2}));
    const auto objects = first == 0 ? std::vector{tank, step} : std::vector{step, tank};
    const Walls walls = make_walls(dimensions, objects, kWide);
    const auto fluid =
        fluid_lattice(dimensions, min, max, [&](const Vec3& x) { return walls.distance_to_any(x) > 0.0; });
    CHECK(worst_sum_error(walls, kWide, fluid, fluid) < kRoundOff);
}

TEST_CASE("Walls.PlanesAlongTheAxesContinueTheLatticeAndMeetInCorners") {
    const int dimensions = GENERATE(2, 3);
    const Domain domain{{0.0, 0.0, 0.0}, {0.8, 0.8, 0.8}, {}};
    std::vector<CollisionObject> objects;
    for (int k = 0; k < dimensions; ++k) {
        Plane low, high;
        low.normal = high.normal = {};
        low.normal[k] = 1.0;
        high.normal[k] = -1.0;
        high.point[k] = 0.8;
        objects.push_back(wall(low));
        objects.push_back(wall(high));
    }
    const Walls walls = make_walls(dimensions, objects, domain);
    const auto fluid = fluid_lattice(dimensions, domain.min, domain.max, anywhere);
    CHECK(worst_sum_error(walls, domain, fluid, fluid) < kRoundOff);
}

TEST_CASE("Walls.PeriodicChannelHasNoSeam") {
    const int dimensions = GENERATE(2, 3);
    const int kind = GENERATE(0, 1, 2);
    Domain domain{{0.0, 0.0, 0.0}, {0.9, 0.7, 0.8}, {true, false, true}};
    if (dimensions == 2) domain.periodic[2] = false;
    std::vector<CollisionObject> objects;
    if (kind == 0) {
        objects.push_back(wall(Plane{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}));
        objects.push_back(wall(Plane{{0.0, 0.7, 0.0}, {0.0, -1.0, 0.0}}));
    } else if (kind == 1) {
        // As long as the period along x, longer along z.
        objects.push_back(wall(box_between({0.0, 0.0, -1.0}, {0.9, 0.7, 2.0}), Role::container));
    } else {
        objects.push_back(wall(box_between({-1.0, -0.8, -1.0}, {2.0, 0.0, 2.0})));
        objects.push_back(wall(box_between({-1.0, 0.7, -1.0}, {2.0, 1.5, 2.0})));
    }
    const Walls walls = make_walls(dimensions, objects, domain);
    const auto fluid = fluid_lattice(dimensions, domain.min, domain.max, anywhere);
    CHECK(worst_sum_error(walls, domain, fluid, fluid) < kRoundOff);
    // No ends: at the domain's boundary the nearest wall is the floor.
    CHECK(walls.distance_to_any({0.001, 0.3, 0.001}) == Approx(0.3).epsilon(1e-12));
}

TEST_CASE("Walls.ObjectAcrossThePeriodicBoundaryIsWhole") {
    const Domain domain{{0.0, 0.0, 0.0}, {1.6, 1.6, 0.0}, {true, true, false}};
    const Walls walls = make_walls(2, {wall(box_between({1.2, -0.4, 0.0}, {2.0, 0.3, 0.0}))}, domain);
    const auto fluid =
        fluid_lattice(2, domain.min, domain.max, [&](const Vec3& x) { return walls.distance_to_any(x) > 0.0; });
    REQUIRE(fluid.size() == 16 * 16 - 8 * 7);
    CHECK(worst_sum_error(walls, domain, fluid, fluid) < kRoundOff);
    const WallParticles& particles = walls.particles();
    for (int k = 0; k < 2; ++k) {
        CHECK(*std::min_element(particles.x[k].begin(), particles.x[k].end()) >= 0.0);
        CHECK(*std::max_element(particles.x[k].begin(), particles.x[k].end()) < 1.6);
    }
}

TEST_CASE("Walls.ATankOfManyPeriodsOrDomainsIsSampledInTheDomainOnly") {
    const Domain domain{{0.0, 0.0, 0.0}, {0.6, 0.6, 0.6}, {}};
    // Its floor is at 0; its other faces are a thousand kilometres away.
    const Walls walls = make_walls(3, {wall(box_between({-1e6, 0.0, -1e6}, {1e6, 1e6, 1e6}), Role::container)}, domain);
    // Domain grown by the depth: at most 13 lattice points along x and z (the lattice need not start at the domain).
    CHECK(walls.particles().size() >= 3 * 12 * 12);
    CHECK(walls.particles().size() <= 3 * 13 * 13);
}

TEST_CASE("Walls.OffsetLatticesKeepTheKernelSumWithinTheLatticesOwnScatter") {
    // A wall that stands anywhere between the fluid's lattice planes along itself: the layers are right, only shifted
    // along the wall. Such a shift changes the sum at a quarter of the lattice's scatter at most.
    const Domain domain{{-0.037, 0.0, 0.0}, {1.0, 1.0, 0.0}, {}};
    const Walls walls = make_walls(2, {wall(Plane{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}})}, domain);
    const auto fluid = fluid_lattice(2, {-0.4, 0.0, 0.0}, {1.2, 1.2, 0.0}, anywhere);
    CHECK(worst_sum_error(walls, domain, fluid, {{0.45, 0.05, 0.0}, {0.55, 0.05, 0.0}}) < 0.01);
}

TEST_CASE("Walls.TiltedPlaneFillsItsSideEvenly") {
    const int dimensions = GENERATE(2, 3);
    const Domain domain{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {}};
    const Vec3 normal = dimensions == 2 ? Vec3{0.6, 0.8, 0.0} : Vec3{0.36, 0.48, 0.8};
    const Walls walls = make_walls(dimensions, {wall(Plane{{0.5, 0.5, 0.5}, normal})}, domain);
    // On the layers' own lattice: half a spacing above the plane, above a lattice point.
    const WallParticles& particles = walls.particles();
    double worst = 0.0;
    int tried = 0;
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const Vec3 x = position_of(particles, k);
        if (walls.distance(0, x) < -0.6 * kDx) continue;
        bool is_inner = true;
        for (int axis = 0; axis < dimensions; ++axis) is_inner &= x[axis] > 0.15 && x[axis] < 0.85;
        if (!is_inner) continue;
        double sum = 0.0, expected = 0.0;
        const Vec3 above = rigid::plus(x, rigid::times(kDx, normal));
        for (std::size_t j = 0; j < particles.size(); ++j) {
            sum += particles.V[j] * kernel_at(dimensions, above, position_of(particles, j));
        }
        for (int i = -3; i <= 3; ++i) {
            for (int j = dimensions == 3 ? -3 : 0; j <= (dimensions == 3 ? 3 : 0); ++j) {
                for (int m = 1; m <= 3; ++m) expected += wendland(dimensions, kDx * std::sqrt(i * i + j * j + m * m));
            }
        }
        worst = std::max(worst, std::abs(sum - expected * std::pow(kDx, dimensions)));
        ++tried;
    }
    REQUIRE(tried > 3);
    CHECK(worst < kRoundOff);
}
