#include <catch2/catch.hpp>

#include "scenes.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

// A tank with a ball in it, the water stirred; not hydrostatic at all.
Scene make_stirred_tank(int dimensions, const ParameterMap& parameters) {
    Scene scene = make_tank(dimensions, dimensions == 2 ? 20 : 10);
    scene.objects.push_back({"ball", Role::obstacle, Sphere{{0.5, 0.3, 0.25}, 0.12}});
    const unsigned seed = 7;
    INFO("seed " << seed);
    displace_randomly(scene.particles, 0.2 * scene.dx, seed);
    set_random_state(scene.particles, 500.0, seed);
    scene.parameters["tension_control"] = false;  // its pairs do not conserve momentum
    for (const auto& [name, value] : parameters) scene.parameters[name] = value;
    return scene;
}

ObjectLoad total_of(const std::vector<ObjectLoad>& loads) {
    ObjectLoad total;
    for (const ObjectLoad& load : loads) {
        for (int k = 0; k < 3; ++k) {
            total.force[k] += load.force[k];
            total.torque[k] += load.torque[k];
        }
    }
    return total;
}

constexpr double kRoundOff = 1e-12;  // some hundred terms a particle, each exact to 1e-16

}  // namespace

TEST_CASE("WcsphLoads.ActionEqualsReaction") {
    // Fluid pairs give no momentum in the adjoint form; so walls gave what gravity did not.
    const int dimensions = GENERATE(2, 3);
    const char* slip = GENERATE("no_slip", "free_slip");
    Scene scene = make_stirred_tank(dimensions, {{"viscosity", 5.0}, {"wall_slip", std::string(slip)}});
    scene.start();
    const std::vector<ObjectLoad> loads = scene.model->object_loads(scene.particles, scene.surroundings());
    REQUIRE(loads.size() == 2);
    const ObjectLoad total = total_of(loads);
    const VectorSum change = sum_over(scene.particles, scene.particles.a);
    double mass = 0.0;
    for (const double m : scene.particles.m) mass += m;
    for (int k = 0; k < dimensions; ++k) {
        const double from_walls = change.sum[k] - (k == 1 ? -9.81 * mass : 0.0);
        CHECK(std::abs(from_walls + total.force[k]) < kRoundOff * change.size);
        CHECK(std::abs(from_walls) > 1e-6 * change.size);  // not trivially 0
        CHECK(std::abs(loads[1].force[k]) > 0.0);          // the ball feels something, too
    }
}

TEST_CASE("WcsphLoads.ReachThroughPeriods") {
    Scene scene = make_periodic_square(14, 0.2);
    scene.domain.periodic[1] = false;
    scene.domain.min[1] = -0.5;
    scene.domain.max[1] = 1.5;
    scene.objects = {{"floor", Role::obstacle, Plane{{0, 0, 0}, {0, 1, 0}}}};
    set_random_state(scene.particles, 500.0, 9);
    for (double& p : scene.particles.p) p += 1000.0;
    scene.parameters["pressure_gradient"] = std::string("adjoint");
    scene.start();
    const ObjectLoad load = scene.model->object_loads(scene.particles, scene.surroundings())[0];
    const VectorSum change = sum_over(scene.particles, scene.particles.a);
    for (int k = 0; k < 2; ++k) CHECK(std::abs(change.sum[k] + load.force[k]) < kRoundOff * change.size);
    CHECK(load.force[1] < -100.0);
}

TEST_CASE("WcsphLoads.TorqueIsReactionToo") {
    // Without gradient correction and viscosity fluid pairs are central: no torque of their own.
    const int dimensions = GENERATE(2, 3);
    Scene scene = make_stirred_tank(dimensions, {{"pressure_gradient", std::string("plain")}});
    scene.start();
    const ObjectLoad total = total_of(scene.model->object_loads(scene.particles, scene.surroundings()));
    Vec3 torque{};
    double size = 0.0;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const Vec3 x = at(scene.particles.x, dimensions, i);
        Vec3 f = at(scene.particles.a, dimensions, i);
        f[1] += 9.81;
        for (int k = 0; k < 3; ++k) {
            const int l = (k + 1) % 3, m = (k + 2) % 3;
            torque[k] += scene.particles.m[i] * (x[l] * f[m] - x[m] * f[l]);
        }
        size += scene.particles.m[i] * length_of(x) * length_of(f);
    }
    for (int k = dimensions == 2 ? 2 : 0; k < 3; ++k) CHECK(std::abs(torque[k] + total.torque[k]) < kRoundOff * size);
    CHECK(std::abs(torque[2]) > 1e-6 * size);
}

TEST_CASE("WcsphLoads.TankCarriesStillWater") {
    Scene scene = make_tank(2, 40);
    scene.start();
    const ObjectLoad load = scene.model->object_loads(scene.particles, scene.surroundings())[0];
    // 1 m x 0.5 m of water, and what compression adds. The walls' share of the pressure force is that of the scheme:
    // 1 % is the kernel's first-moment error at R = 3 dx on the free surface's own uncorrected particles.
    CHECK(load.force[1] == Approx(-1000.0 * 9.81 * 0.5).epsilon(0.01));
    CHECK(std::abs(load.force[0]) < 1e-9 * std::abs(load.force[1]));  // left and right are mirror images
    CHECK(load.torque[2] == Approx(0.5 * load.force[1]).epsilon(1e-6));
}

TEST_CASE("WcsphLoads.PanelFeelsBothSides") {
    // A thin panel between equal columns: their thrusts cancel; without one of them it carries rho g h^2/2.
    Scene scene = make_tank(2, 40);
    scene.objects.push_back({"panel", Role::obstacle, Box{{0.5, 1.0, 0.0}, {0.025, 1.0, 1.0}}});
    const auto thrust_with = [&](bool is_one_sided) {
        Scene half = make_tank(2, 40);
        half.objects = scene.objects;
        std::vector<Vec3> points;
        std::vector<double> pressures;
        for (std::size_t i = 0; i < scene.particles.size(); ++i) {
            const Vec3 x = at(scene.particles.x, 2, i);
            if (std::abs(x[0] - 0.5) < scene.dx || (is_one_sided && x[0] > 0.5)) continue;
            points.push_back(x);
            pressures.push_back(scene.particles.p[i]);
        }
        half.particles = make_particles(2, points);
        half.particles.p = pressures;
        half.start();
        return half.model->object_loads(half.particles, half.surroundings())[1].force[0];
    };
    const double thrust = 1000.0 * 9.81 * 0.5 * 0.5 * 0.5;
    // The surface's half spacing, whose particles are not corrected: 1/20 of the depth.
    CHECK(thrust_with(true) == Approx(thrust).epsilon(0.05));
    CHECK(std::abs(thrust_with(false)) < 1e-9 * thrust);
}

TEST_CASE("WcsphLoads.ObjectsAreKnownByName") {
    Scene scene = make_stirred_tank(2, {});
    scene.start();
    const std::vector<ObjectLoad> before = scene.model->object_loads(scene.particles, scene.surroundings());
    // As after a mutation between two steps: the ball is gone, another object stands before the tank.
    scene.objects.pop_back();
    scene.objects.insert(scene.objects.begin(), {"new", Role::obstacle, Sphere{{0.2, 0.2, 0.0}, 0.1}});
    ++scene.objects_version;
    const std::vector<ObjectLoad> after = scene.model->object_loads(scene.particles, scene.surroundings());
    REQUIRE(after.size() == 2);
    CHECK(after[0].force == Vec3{});
    CHECK(after[1].force == before[0].force);
}

TEST_CASE("WcsphLoads.NeedNoOrderOfThreads") {
    Scene scene = make_stirred_tank(2, {{"viscosity", 5.0}, {"wall_slip", std::string("no_slip")}});
    scene.start();
    std::vector<ObjectLoad> one, three;
    with_threads(1, [&] { one = scene.model->object_loads(scene.particles, scene.surroundings()); });
    with_threads(3, [&] { three = scene.model->object_loads(scene.particles, scene.surroundings()); });
    for (std::size_t o = 0; o < one.size(); ++o) {
        CHECK(one[o].force == three[o].force);
        CHECK(one[o].torque == three[o].torque);
    }
}
