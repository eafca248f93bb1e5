// Walls as a whole: sides, normals, order of objects, motion.
#include <algorithm>
#include <random>
#include <stdexcept>

#include "wall_checks.h"

using namespace headrace::solver;

namespace {

const Domain kWide{{-2.0, -2.0, -2.0}, {2.0, 2.0, 2.0}, {}};

// One of each primitive and role, apart from each other or not.
std::vector<CollisionObject> one_of_each(int dimensions) {
    std::vector<CollisionObject> objects{
        wall(box_between({-1.5, -1.5, -1.5}, {1.5, 1.6, 1.7}), Role::container),
        wall(Sphere{{0.1, 0.0, 0.0}, 1.45}, Role::container),
        wall(box_between({-0.9, -0.3, -0.5}, {-0.1, 0.51, 0.5})),
        wall(Sphere{{0.7, 0.3, 0.1}, 0.45}),
        wall(Plane{{0.0, -1.1, 0.0}, {0.0, 1.0, 0.0}}),
        wall(Plane{{0.9, 0.9, 0.0}, {-0.6, -0.8, 0.0}}),
    };
    if (dimensions == 3) {
        objects.push_back(wall(Cylinder{{0.0, 0.2, 0.0}, {0.48, 0.6, 0.64}, 1.3, 1.2}, Role::container));
        objects.push_back(wall(Cylinder{{0.2, -0.6, 0.3}, {0.0, 0.6, -0.8}, 0.35, 0.4}));
    }
    return objects;
}

// Swings about a pivot while it moves on: all derivatives by hand.
RigidState swing(double t) {
    const double angle = 0.6 * std::sin(1.7 * t), rate = 0.6 * 1.7 * std::cos(1.7 * t),
                 change = -0.6 * 1.7 * 1.7 * std::sin(1.7 * t);
    const double c = std::cos(angle), s = std::sin(angle);
    RigidState state;
    state.pivot = {0.2, -0.1, 0.0};
    state.translation = {0.3 * t * t, 0.2 * std::sin(t), 0.0};
    state.velocity = {0.6 * t, 0.2 * std::cos(t), 0.0};
    state.acceleration = {0.6, -0.2 * std::sin(t), 0.0};
    state.rotation = {c, -s, 0, s, c, 0, 0, 0, 1};
    state.angular_velocity = {0.0, 0.0, rate};
    state.angular_acceleration = {0.0, 0.0, change};
    return state;
}

CollisionObject moving(CollisionObject object, std::function<RigidState(double)> motion) {
    object.motion = std::move(motion);
    return object;
}

RigidState shift(const Vec3& displacement, const Vec3& velocity = {}) {
    RigidState state;
    state.translation = displacement;
    state.velocity = velocity;
    return state;
}

bool same(const WallParticles& a, const WallParticles& b) {
    return a.id == b.id && a.object == b.object && a.sheet == b.sheet && a.x == b.x && a.v == b.v && a.a == b.a &&
           a.n == b.n && a.V == b.V && a.depth == b.depth;
}

}  // namespace

TEST_CASE("Walls.NoDummyStandsInTheFluid") {
    const int dimensions = GENERATE(2, 3);
    for (const CollisionObject& object : one_of_each(dimensions)) {
        const Walls walls = make_walls(dimensions, {object}, kWide);
        const WallParticles& particles = walls.particles();
        REQUIRE(particles.size() > 0);
        for (std::size_t k = 0; k < particles.size(); ++k) {
            const double distance = walls.distance(0, position_of(particles, k));
            // The first layer is half a spacing deep; cells of a box's inner lattice and of rings are near that.
            REQUIRE(distance < -0.4 * kDx);
            REQUIRE(particles.V[k] > 0.0);
        }
    }
}

TEST_CASE("Walls.NormalsLeadFromDummiesToTheNearestSurface") {
    const int dimensions = GENERATE(2, 3);
    for (const CollisionObject& object : one_of_each(dimensions)) {
        const Walls walls = make_walls(dimensions, {moving(object, swing)}, kWide, 0.4);
        const WallParticles& particles = walls.particles();
        for (std::size_t k = 0; k < particles.size(); ++k) {
            Vec3 n{particles.n[0][k], particles.n[1][k], 0.0};
            if (dimensions == 3) n[2] = particles.n[2][k];
            const Vec3 x = position_of(particles, k);
            REQUIRE(rigid::length(n) == Approx(1.0).epsilon(kSingle));
            const Vec3 foot = rigid::plus(x, rigid::times(-walls.distance(0, x), n));
            REQUIRE(std::abs(walls.distance(0, foot)) < kSingle);
        }
    }
}

TEST_CASE("Walls.DistanceGrowsAlongTheNormal") {
    const int dimensions = GENERATE(2, 3);
    const unsigned seed = 7057;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> somewhere(-1.8, 1.8);
    const double step = 1e-6;
    for (const CollisionObject& object : one_of_each(dimensions)) {
        const Walls walls = make_walls(dimensions, {moving(object, swing)}, kWide, 0.9);
        int exact = 0;
        for (int trial = 0; trial < 200; ++trial) {
            const Vec3 x{somewhere(random), somewhere(random), dimensions == 3 ? somewhere(random) : 0.0};
            Vec3 n;
            const double before = walls.distance(0, x, &n);
            const double after = walls.distance(0, rigid::plus(x, rigid::times(step, n)));
            REQUIRE(after - before <= step * 1.0001);
            exact += std::abs(after - before - step) < 1e-10;
        }
        CHECK(exact >= 198);  // a step over the medial axis may fall short
    }
}

TEST_CASE("Walls.ADummyBelongsToTheFirstSolidThatHoldsIt") {
    const int dimensions = GENERATE(2, 3);
    const auto objects = one_of_each(dimensions);
    const Walls walls = make_walls(dimensions, objects, kWide);
    const WallParticles& particles = walls.particles();
    std::vector<std::size_t> of_object(objects.size());
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const Vec3 x = position_of(particles, k);
        std::size_t nearest_object = objects.size();
        REQUIRE(walls.distance_to_any(x, &nearest_object) < 0.0);
        for (std::size_t earlier = 0; earlier < particles.object[k]; ++earlier) {
            REQUIRE(walls.distance(earlier, x) > -1e-9);
        }
        ++of_object[particles.object[k]];
    }
    // None is lost that should be there: each object alone has as many where no earlier solid is.
    for (std::size_t object = 0; object < objects.size(); ++object) {
        const Walls alone = make_walls(dimensions, {objects[object]}, kWide);
        std::size_t expected = 0;
        for (std::size_t k = 0; k < alone.particles().size(); ++k) {
            const Vec3 x = position_of(alone.particles(), k);
            bool is_free = true;
            for (std::size_t earlier = 0; earlier < object; ++earlier) is_free &= walls.distance(earlier, x) > -1e-9;
            expected += is_free;
        }
        CHECK(of_object[object] == expected);
    }
}

TEST_CASE("Walls.MotionOfDummiesIsTheDerivativeOfTheirPlaces") {
    const int dimensions = GENERATE(2, 3);
    const auto objects =
        std::vector{moving(wall(box_between({-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3}), Role::container), swing)};
    Walls walls = make_walls(dimensions, objects, kWide, 0.0);
    const double t = 0.8, dt = 1e-4;
    REQUIRE(walls.move_to(t - dt));
    const WallParticles before = walls.particles();
    REQUIRE(walls.move_to(t + dt));
    const WallParticles after = walls.particles();
    REQUIRE(walls.move_to(t));
    const WallParticles& now = walls.particles();
    REQUIRE(now.id == before.id);
    REQUIRE(now.id == after.id);
    for (std::size_t k = 0; k < now.size(); ++k) {
        for (int axis = 0; axis < dimensions; ++axis) {
            const double slope = (after.x[axis][k] - before.x[axis][k]) / (2.0 * dt);
            // Central differences: dt^2/6 times the third derivative, at most some 10 m/s^3.
            REQUIRE(now.v[axis][k] == Approx(slope).margin(1e-6));
            const double rate = (after.v[axis][k] - before.v[axis][k]) / (2.0 * dt);
            REQUIRE(now.a[axis][k] == Approx(rate).margin(1e-6));
        }
        Vec3 v = walls.velocity(0, position_of(now, k));
        for (int axis = 0; axis < dimensions; ++axis) REQUIRE(v[axis] == Approx(now.v[axis][k]).margin(kRoundOff));
    }
}

TEST_CASE("Walls.ABeltMovesTheSurfaceAlongItselfAndNothingElse") {
    double speed = 1.5;
    const auto belt = [&speed](double t) {
        RigidState state;
        state.surface_velocity = {speed * t, 0.0, 0.0};
        return state;
    };
    const Domain domain{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {}};
    Walls walls = make_walls(2, {moving(wall(box_between({}, {1.0, 1.0, 0.0}), Role::container), belt)}, domain, 1.0);
    const WallParticles start = walls.particles();
    CHECK(!walls.move_to(2.0));
    const WallParticles& particles = walls.particles();
    CHECK(particles.x == start.x);
    int tangential = 0, normal = 0;
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const double along = particles.v[0][k] * particles.n[0][k] + particles.v[1][k] * particles.n[1][k];
        REQUIRE(std::abs(along) < 3.0 * kSingle);
        REQUIRE(particles.a[0][k] == 0.0);
        if (std::abs(particles.n[1][k]) == 1.0) {
            REQUIRE(particles.v[0][k] == 3.0);
            ++tangential;
        }
        if (std::abs(particles.n[0][k]) == 1.0) {
            REQUIRE(particles.v[0][k] == 0.0);
            ++normal;
        }
    }
    CHECK(tangential == 60);
    CHECK(normal == 60);
    CHECK(walls.velocity(0, {0.5, 0.02, 0.0})[0] == 3.0);
    CHECK(walls.velocity(0, {0.02, 0.5, 0.0})[0] == 0.0);
}

TEST_CASE("Walls.ObjectsAtRestNeverMove") {
    Walls walls = make_walls(3, one_of_each(3), kWide);
    const WallParticles start = walls.particles();
    CHECK(!walls.has_moving());
    CHECK(!walls.move_to(3.0));
    CHECK(same(walls.particles(), start));
}

TEST_CASE("Walls.OnlyWhereObjectsMoveHaveDummiesVelocities") {
    const CollisionObject tank = wall(box_between({}, {1.0, 1.0, 1.0}), Role::container);
    const WallParticles at_rest = make_walls(3, {tank}, kWide).particles();
    REQUIRE(at_rest.size() > 0);
    CHECK(at_rest.sheet.empty());
    const WallParticles swinging = make_walls(3, {moving(tank, swing)}, kWide, 0.0).particles();
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(at_rest.v[axis].empty());
        CHECK(at_rest.a[axis].empty());
        CHECK(swinging.v[axis].size() == swinging.size());
        CHECK(swinging.a[axis].size() == swinging.size());
    }
}

TEST_CASE("Walls.MovingThereEqualsBeingBuiltThere") {
    // A gate that goes down through the floor, a post after it in the scene, a tank between them: cuts of all kinds
    // change, by long ways and by some that change none.
    const auto down = [](double t) { return shift({0.0, -t, 0.0}, {0.0, -1.0, 0.0}); };
    const std::vector objects{
        wall(box_between({0.15, 0.2, 0.0}, {0.25, 0.9, 0.0})),  // thin, at rest; its sheet reaches the gate's place
        moving(wall(box_between({0.3, 0.4, 0.0}, {1.0, 1.1, 0.0})), down),
        wall(box_between({}, {1.6, 1.2, 0.0}), Role::container),
        moving(wall(box_between({1.2, 0.5, 0.0}, {1.3, 1.1, 0.0})), down),  // thin
        wall(Sphere{{0.6, 0.2, 0.0}, 0.45}),
    };
    Walls walls = make_walls(2, objects, kWide, 0.0);
    const std::size_t at_start = walls.particles().size();
    bool has_changed = false;
    for (const double t : {0.05, 0.050001, 0.33, 0.7, 0.700001, 1.4, 0.2}) {
        CHECK(walls.move_to(t));
        CHECK(same(walls.particles(), make_walls(2, objects, kWide, t).particles()));
        has_changed |= walls.particles().size() != at_start;
        // The resting panel's sheet leaves the gate's solid to the gate, wherever that is.
        const WallParticles& particles = walls.particles();
        for (std::size_t k = 0; k < particles.size(); ++k) {
            if (particles.object[k] == 0 && walls.distance(0, position_of(particles, k)) > 0.0) {
                REQUIRE(walls.distance(1, position_of(particles, k)) > -1e-9);
            }
        }
    }
    CHECK(has_changed);
}

TEST_CASE("Walls.SortedDummiesMoveAsUnsortedOnes") {
    const auto drift = [](double t) { return shift({t, 0.0, 0.0}, {1.0, 0.0, 0.0}); };
    const std::vector objects{wall(Plane{{0.0, -0.5, 0.0}, {0.0, 1.0, 0.0}}), moving(wall(Sphere{{}, 0.33}), drift)};
    Walls walls = make_walls(2, objects, kWide), plain = make_walls(2, objects, kWide);
    WallParticles& particles = walls.particles();
    const auto reverse = [](auto& list) { std::reverse(list.begin(), list.end()); };
    reverse(particles.id), reverse(particles.object), reverse(particles.sheet), reverse(particles.V);
    reverse(particles.depth);
    for (int axis = 0; axis < 2; ++axis) {
        for (VectorField* field : {&particles.x, &particles.v, &particles.a}) reverse((*field)[axis]);
        reverse(particles.n[axis]);
    }
    CHECK(walls.move_to(0.01));
    CHECK(plain.move_to(0.01));
    const WallParticles& expected = plain.particles();
    REQUIRE(particles.size() == expected.size());
    std::vector<std::size_t> slot(particles.size());
    for (std::size_t k = 0; k < particles.size(); ++k) slot[particles.id[k]] = k;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const std::size_t here = slot[expected.id[k]];
        REQUIRE(particles.x[0][here] == expected.x[0][k]);
        REQUIRE(particles.v[0][here] == expected.v[0][k]);
        REQUIRE(particles.object[here] == expected.object[k]);
    }
}

TEST_CASE("Walls.DepthIsTheDistanceToTheSurface") {
    const int dimensions = GENERATE(2, 3);
    for (const CollisionObject& object : one_of_each(dimensions)) {
        const Walls walls = make_walls(dimensions, {object}, kWide);
        const WallParticles& particles = walls.particles();
        for (std::size_t k = 0; k < particles.size(); ++k) {
            REQUIRE(particles.depth[k] == Approx(-walls.distance(0, position_of(particles, k))).epsilon(kSingle));
        }
    }
    // In a panel's sheet it goes on behind the opposite face.
    const Walls walls = make_walls(dimensions, {wall(box_between({0.0, -1.0, -1.0}, {0.1, 1.0, 1.0}))}, kWide);
    const WallParticles& particles = walls.particles();
    for (std::size_t k = 0; k < particles.size(); ++k) {
        if (particles.sheet[k] == 1 && particles.n[0][k] == -1.0) {
            REQUIRE(particles.depth[k] == Approx(particles.x[0][k]).epsilon(kSingle));
        }
    }
}

TEST_CASE("Walls.AMovingPlaneKeepsTheWholeDomainCovered") {
    const int dimensions = GENERATE(2, 3);
    const Domain domain{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {}};
    const auto slide = [](double t) { return shift({17.31 * t, -0.05 * t, -5.3 * t}); };
    const auto tilt = [](double t) {
        RigidState state;
        state.pivot = {0.5, 0.4, 0.5};
        const double c = std::cos(0.3 * t), s = std::sin(0.3 * t);
        state.rotation = {c, -s, 0, s, c, 0, 0, 0, 1};
        return state;
    };
    for (const auto& motion : std::vector<std::function<RigidState(double)>>{slide, tilt}) {
        const std::vector objects{moving(wall(Plane{{0.5, 0.4, 0.5}, {0.0, 1.0, 0.0}}), motion)};
        Walls walls = make_walls(dimensions, objects, domain);
        for (const double t : {0.0, 0.4, 1.7, 3.1}) {
            walls.move_to(t);
            // All dummies are at lattice points, so the volume of those in the inner half of the domain must be that
            // of the layers there; counted around points of the first layer.
            const WallParticles& particles = walls.particles();
            int tried = 0;
            for (std::size_t k = 0; k < particles.size(); ++k) {
                const Vec3 x = position_of(particles, k);
                bool is_inner = walls.distance(0, x) > -0.6 * kDx;
                for (int axis = 0; axis < dimensions; ++axis) is_inner &= x[axis] > 0.0 && x[axis] < 1.0;
                if (!is_inner) continue;
                int around = 0;
                for (std::size_t j = 0; j < particles.size(); ++j) {
                    around += rigid::length(rigid::minus(x, position_of(particles, j))) < 1.1 * kDx;
                }
                REQUIRE(around == 2 * (dimensions - 1) + 2);  // itself, its neighbours in the layer, the one below
                ++tried;
            }
            CHECK(tried >= (dimensions == 2 ? 9 : 81));
        }
    }
}

TEST_CASE("Walls.AContainerThatNearlyFillsThePeriodStaysOutOfItsFluid") {
    // Between one period's right wall and the next one's left wall are two spacings of solid, less than the depth.
    const Domain domain{{0.0, 0.0, 0.0}, {1.6, 2.0, 0.0}, {true, false, false}};
    const Primitive shape =
        GENERATE(Primitive{Sphere{{0.5, 1.0, 0.0}, 0.7}}, Primitive{box_between({-0.2, 0.3, 0.0}, {1.2, 1.7, 0.0})});
    const Walls walls = make_walls(2, {wall(shape, Role::container)}, domain);
    const WallParticles& particles = walls.particles();
    for (std::size_t k = 0; k < particles.size(); ++k) {
        REQUIRE(walls.distance(0, position_of(particles, k)) < -0.4 * kDx);
        for (std::size_t j = 0; j < k; ++j) {
            const Vec3 a = position_of(particles, k), b = nearest(domain, a, position_of(particles, j));
            if (std::holds_alternative<Box>(shape)) REQUIRE(rigid::length(rigid::minus(a, b)) > 0.9 * kDx);
        }
    }
}

TEST_CASE("Walls.AMovingTankCarriesItsLatticeAcrossThePeriod") {
    const Domain domain{{0.0, 0.0, 0.0}, {1.6, 1.0, 0.0}, {true, false, false}};
    const auto drift = [](double t) { return shift({0.1 * std::round(t), 0.0, 0.0}); };
    const std::vector objects{wall(Plane{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}),
                              wall(Plane{{0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}}),
                              moving(wall(box_between({0.3, 0.0, 0.0}, {1.0, 0.7, 0.0})), drift)};
    Walls walls = make_walls(2, objects, domain, 0.0);
    for (const double t : {3.0, 10.0, 16.0, -37.0}) {
        walls.move_to(t);
        const auto fluid =
            fluid_lattice(2, domain.min, domain.max, [&](const Vec3& x) { return walls.distance_to_any(x) > 0.0; });
        REQUIRE(fluid.size() == 16 * 10 - 7 * 7);
        CHECK(worst_sum_error(walls, domain, fluid, fluid) < kRoundOff);
    }
}

TEST_CASE("Walls.DegenerateAndHugeObjectsAreHarmless") {
    const Domain domain{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {}};
    const Vec3 p{0.5, 0.5, 0.5};
    for (const int dimensions : {2, 3}) {
        CHECK(make_walls(dimensions, {wall(Sphere{p, 0.0})}, domain).particles().size() == 0);
        CHECK(make_walls(dimensions, {wall(box_between(p, p))}, domain).particles().size() == 0);
        CHECK(make_walls(dimensions, {}, domain).distance_to_any(p) == std::numeric_limits<double>::infinity());
        // A container of no size: its lines and points have no volume, its corners have.
        CHECK(make_walls(dimensions, {wall(box_between(p, p), Role::container)}, domain).particles().size() > 0);
        // Far away, or all around the domain and deeper than anyone looks.
        CHECK(make_walls(dimensions, {wall(Sphere{{90.0, 0.0, 0.0}, 5.0})}, domain).particles().size() == 0);
        CHECK(make_walls(dimensions, {wall(box_between({-1e7, -1e7, -1e7}, {1e7, 1e7, 1e7}))}, domain)
                  .particles()
                  .size() == 0);
        CHECK(make_walls(dimensions, {wall(Sphere{p, 1e12}, Role::container)}, domain).particles().size() == 0);
        CHECK(make_walls(dimensions, {wall(Sphere{p, 1e12})}, domain).particles().size() == 0);
    }
}

TEST_CASE("Walls.AHugeDrumShowsOnlyItsEnds") {
    const Domain domain{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {}};
    const Cylinder drum{{0.5, 5e11 + 0.2, 0.5}, {0.0, 1.0, 0.0}, 1e12, 5e11};
    const Walls tank = make_walls(3, {wall(drum, Role::container)}, domain);
    // Three layers below y = 0.2, over 1.6 x 1.6 of the grown domain.
    double V = 0.0;
    for (const double one : tank.particles().V) V += one;
    CHECK(V == Approx(1.6 * 1.6 * 0.3).epsilon(0.1));
}

TEST_CASE("Walls.TooManyDummiesAreRefusedBeforeTheyFillTheMemory") {
    // What moves is sampled whole: ten thousand spacings a side are too many in 3D.
    Walls walls(3, kDx, kSupport);
    const auto still = [](double) { return RigidState{}; };
    const std::vector objects{moving(wall(box_between({-500.0, -500.0, -500.0}, {500.0, 500.0, 500.0})), still)};
    CHECK_THROWS_AS(walls.rebuild(objects, kWide, 0.0), std::length_error);
    const std::vector sphere{moving(wall(Sphere{{}, 1e300}), still)};
    CHECK_THROWS_AS(walls.rebuild(sphere, kWide, 0.0), std::length_error);
    const std::vector large{moving(wall(Sphere{{}, 500.0}), still)};
    CHECK_THROWS_AS(walls.rebuild(large, kWide, 0.0), std::length_error);
    const std::vector drum{moving(wall(Cylinder{{}, {0.0, 0.0, 1.0}, 500.0, 500.0}), still)};
    CHECK_THROWS_AS(walls.rebuild(drum, kWide, 0.0), std::length_error);
}
