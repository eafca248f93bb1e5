// Scenes whose walls are integrals of the kernel instead of dummy particles.
#include <algorithm>
#include <catch2/catch.hpp>

#include "scenes.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

using std::string;

namespace {

Scene with_integrals(Scene scene) {
    scene.parameters["walls"] = string("integrals");
    return scene;
}

// The stage "walls" of the plan tells what they are made of.
string walls_of(const Scene& scene) {
    for (const Stage& stage : scene.model->plan(scene.surroundings())) {
        if (stage.name == "walls") return stage.reason;
    }
    return {};
}

bool is_without_dummies(const Scene& scene) {
    return walls_of(scene).find("integrals") != string::npos && walls_of(scene).find("particles (") == string::npos &&
           walls_of(scene).find("wall particles") == string::npos;
}

double largest_acceleration(const Particles& particles) {
    double largest = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        largest = std::max(largest, length_of(at(particles.a, particles.dimensions, i)));
    return largest;
}

// A tank with a ball and a block in it, the water stirred; not hydrostatic at all.
Scene make_stirred_tank(int dimensions) {
    Scene scene = with_integrals(make_tank(dimensions, dimensions == 2 ? 24 : 14));
    const double R = 3.0 * scene.dx, z = dimensions == 3 ? 0.25 : 0.0;
    scene.objects.push_back({"ball", Role::obstacle, Sphere{{0.25, 0.4, z}, 1.1 * R}});
    scene.objects.push_back({"block", Role::obstacle, Box{{0.75, 1.01 * R, z}, {1.01 * R, 1.01 * R, 1.01 * R}}});
    displace_randomly(scene.particles, 0.2 * scene.dx, 7);
    set_random_state(scene.particles, 500.0, 7);
    for (double& p : scene.particles.p) p += 800.0;
    scene.parameters["tension_control"] = false;  // its pairs do not conserve momentum
    return scene;
}

}  // namespace

TEST_CASE("IntegralScenes.StillWaterHardlyAccelerates") {
    // As with dummies (Wcsph.StillWaterHardlyAccelerates): away from the free surface the lattice balances.
    const int dimensions = GENERATE(2, 3);
    Scene scene = with_integrals(make_tank(dimensions, dimensions == 2 ? 24 : 14, 1.0));
    REQUIRE_FALSE(scene.start().fault);
    REQUIRE(is_without_dummies(scene));
    const double R = 3.0 * scene.dx;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const Vec3 x = at(scene.particles.x, dimensions, i);
        if (x[1] > 1.0 - R) continue;
        INFO(dimensions << "D, at " << x[0] << ' ' << x[1] << ' ' << x[2]);
        REQUIRE(length_of(at(scene.particles.a, dimensions, i)) < 0.35);  // [m/s^2] g = 9.81
    }
}

TEST_CASE("IntegralScenes.FreeSurfaceIsAsCalmAtAWallAsFarFromIt") {
    // The sums end at the surface, where the uppermost layers therefore accelerate: alike at a wall and far from it,
    // since the solid continues the fluid. Dummies beside air double it.
    const int dimensions = GENERATE(2, 3);
    Scene scene = with_integrals(make_tank(dimensions, dimensions == 2 ? 24 : 20, 1.0));
    REQUIRE_FALSE(scene.start().fault);
    const double dx = scene.dx;
    for (const double layer : {0.5, 1.5}) {
        std::vector<double> at_wall, far;
        for (std::size_t i = 0; i < scene.particles.size(); ++i) {
            const Vec3 x = at(scene.particles.x, dimensions, i), a = at(scene.particles.a, dimensions, i);
            if (std::abs(1.0 - x[1] - layer * dx) > 0.1 * dx) continue;
            if (dimensions == 3 && std::abs(x[2] - 0.25) > dx) continue;
            if (x[0] < dx) at_wall.push_back(a[1]);
            if (std::abs(x[0] - 0.5) < dx) far.push_back(a[1]);
        }
        REQUIRE(!at_wall.empty());
        REQUIRE(!far.empty());
        INFO(dimensions << "D, layer " << layer);
        CHECK(std::abs(far[0]) > 0.1);
        for (const double a : at_wall) CHECK(a == Approx(far[0]).epsilon(0.1));  // what B differs by
    }
}

TEST_CASE("IntegralScenes.WaterFallsFreelyAlongWalls") {
    // No pressure in it: nothing holds it up or draws it aside, whatever gravity would make of its weight.
    const int dimensions = GENERATE(2, 3);
    Scene scene = with_integrals(make_tank(dimensions, dimensions == 2 ? 24 : 14));
    for (double& y : scene.particles.x[1]) y += 1.0;
    std::fill(scene.particles.p.begin(), scene.particles.p.end(), 0.0);
    REQUIRE_FALSE(scene.start().fault);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const Vec3 a = at(scene.particles.a, dimensions, i);
        REQUIRE(length_of({a[0], a[1] + 9.81, a[2]}) < 1e-12);
    }
}

TEST_CASE("IntegralScenes.PressureAlongAWallAcceleratesTheFluidThereAsFarFromIt") {
    // Linear pressure along a channel, its floor a plane: particles on the floor feel the slope in full.
    const char* gradient = GENERATE("difference", "adjoint");
    Scene scene = with_integrals(make_periodic_square(24));
    scene.domain.periodic[0] = false;
    scene.domain.min = {-1, -1, -1};
    scene.domain.max = {2, 2, 2};
    scene.objects = {{"floor", Role::obstacle, Plane{{0, 0, 0}, {0, 1, 0}}}};
    for (std::size_t i = 0; i < scene.particles.size(); ++i) scene.particles.p[i] = 1000.0 * scene.particles.x[0][i];
    scene.parameters["pressure_gradient"] = string(gradient);
    scene.parameters["sound_speed"] = 100.0;
    REQUIRE_FALSE(scene.start().fault);
    const double R = 3.0 * scene.dx;
    int near = 0;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const Vec3 x = at(scene.particles.x, 2, i), a = at(scene.particles.a, 2, i);
        if (x[0] < 2.0 * R || x[0] > 1.0 - 2.0 * R || x[1] > R) continue;
        INFO(gradient << ", height " << x[1] / scene.dx << " dx");
        REQUIRE(a[0] == Approx(-1.0).epsilon(0.02));  // compressed by 1e-4; the lattice's own error is 0.3 %
        ++near;
    }
    REQUIRE(near > 30);
}

TEST_CASE("IntegralScenes.ActionEqualsReaction") {
    const int dimensions = GENERATE(2, 3);
    const char* slip = GENERATE("no_slip", "free_slip");
    Scene scene = make_stirred_tank(dimensions);
    scene.parameters["viscosity"] = 5.0;
    scene.parameters["wall_slip"] = string(slip);
    REQUIRE_FALSE(scene.start().fault);
    REQUIRE(is_without_dummies(scene));
    const std::vector<ObjectLoad> loads = scene.model->object_loads(scene.particles, scene.surroundings());
    REQUIRE(loads.size() == 3);
    const VectorSum change = sum_over(scene.particles, scene.particles.a);
    double mass = 0.0;
    for (const double m : scene.particles.m) mass += m;
    for (int k = 0; k < dimensions; ++k) {
        double total = 0.0;
        for (const ObjectLoad& load : loads) {
            total += load.force[k];
            CHECK(std::abs(load.force[k]) > 0.0);
        }
        const double from_walls = change.sum[k] - (k == 1 ? -9.81 * mass : 0.0);
        CHECK(std::abs(from_walls + total) <
              1e-11 * change.size);                        // some hundred terms a particle, each exact to 1e-16
        CHECK(std::abs(from_walls) > 1e-6 * change.size);  // not trivially 0
    }
}

TEST_CASE("IntegralScenes.InspectionsTermsAddUpToTheModelsAcceleration") {
    const int dimensions = GENERATE(2, 3);
    const char* gradient = GENERATE("adjoint", "difference");
    Scene scene = make_stirred_tank(dimensions);
    scene.parameters["pressure_gradient"] = string(gradient);
    scene.parameters["viscosity"] = 3.0;
    scene.parameters["artificial_viscosity"] = 0.05;
    scene.parameters["wall_slip"] = string("no_slip");
    REQUIRE_FALSE(scene.start().fault);
    const double largest = largest_acceleration(scene.particles);
    for (std::size_t i = 0; i < scene.particles.size(); i += 5) {
        const auto found = scene.model->inspect(scene.particles, scene.surroundings(), scene.particles.id[i]);
        REQUIRE(found);
        for (int k = 0; k < dimensions; ++k)
            REQUIRE(std::abs(scene.particles.a[k][i] - found->a[k]) <= 1e-11 * largest);  // order of summation
    }
    const auto in_corner = scene.model->inspect(scene.particles, scene.surroundings(), 0);
    CHECK(std::count_if(in_corner->neighbours.begin(), in_corner->neighbours.end(),
                        [](const auto& one) { return one.object == "tank"; }) == dimensions);
}

TEST_CASE("IntegralScenes.HaveTheSameBitsForAnyThreadCount") {
    const int dimensions = GENERATE(2, 3);
    std::uint64_t one = 0;
    for (const int threads : {1, 2, 3, 4}) {
        Scene scene = make_stirred_tank(dimensions);
        scene.parameters["viscosity"] = 1.0;
        scene.parameters["wall_slip"] = string("no_slip");
        with_threads(threads, [&] {
            REQUIRE_FALSE(scene.start().fault);
            for (int k = 0; k < 4; ++k) REQUIRE_FALSE(scene.step().fault);
        });
        const std::uint64_t hash = compute_state_hash(scene.particles);
        if (threads == 1) one = hash;
        CHECK(hash == one);
    }
}

TEST_CASE("IntegralScenes.NothingLeaksUnderAnImpact") {
    // A block of water thrown into a corner at a fifth of the sound speed.
    const int dimensions = GENERATE(2, 3);
    Scene scene = with_integrals(make_tank(dimensions, dimensions == 2 ? 24 : 12));
    for (int k = 0; k < dimensions; ++k) std::fill(scene.particles.v[k].begin(), scene.particles.v[k].end(), -4.0);
    REQUIRE_FALSE(scene.start().fault);
    for (int k = 0; k < 150; ++k) REQUIRE_FALSE(scene.step().fault);
    const double depth = dimensions == 3 ? 0.5 : 1.0;
    const Vec3 high{1.0, 2.0, depth};
    for (int k = 0; k < dimensions; ++k) {
        for (const double x : scene.particles.x[k]) {
            REQUIRE(x >= 0.0);
            REQUIRE(x <= high[k]);
        }
    }
}

TEST_CASE("IntegralScenes.TankCarriesStillWater") {
    Scene scene = with_integrals(make_tank(2, 24));
    REQUIRE_FALSE(scene.start().fault);
    double mass = 0.0;
    for (const double m : scene.particles.m) mass += m;
    const ObjectLoad load = scene.model->object_loads(scene.particles, scene.surroundings())[0];
    CHECK(load.force[1] == Approx(-9.81 * mass).epsilon(0.02));  // what still accelerates at the surface
    CHECK(std::abs(load.force[0]) < 1e-9 * 9.81 * mass);
}

TEST_CASE("IntegralScenes.FluidIsStiffEnoughForTheSpeedOfTheirSurfaces") {
    // Ten times the fastest wall, as with particles: nothing else moves the fluid.
    const char* walls = GENERATE("integrals", "particles");
    Scene scene = make_periodic_square(24);
    scene.domain = {{-1, -1, -1}, {2, 2, 2}};
    CollisionObject lid{"lid", Role::obstacle, Plane{{0, 1, 0}, {0, -1, 0}}};
    lid.motion = [](double) {
        RigidState state;
        state.surface_velocity = {0.7, 0.0, 0.0};
        return state;
    };
    lid.is_belt = true;
    scene.objects = {lid};
    scene.parameters["walls"] = string(walls);
    scene.parameters["gravity"] = Vec3{};
    scene.parameters.erase("sound_speed");
    REQUIRE_FALSE(scene.start().fault);
    CHECK(is_without_dummies(scene) == (string(walls) == "integrals"));
    CHECK(std::get<double>(scene.model->parameters().at("sound_speed")) == Approx(7.0));
}

TEST_CASE("IntegralScenes.OthersStayParticles") {
    Scene scene = with_integrals(make_tank(2, 24));
    SECTION("with surface tension, which looks into the walls") {
        scene.parameters["surface_tension"] = 0.1;
    }
    SECTION("where something moves") {
        CollisionObject piston{"piston", Role::obstacle, Box{{0.5, 1.8, 0.0}, {0.3, 0.2, 1.0}}};
        piston.motion = [](double) { return RigidState{}; };
        scene.objects.push_back(piston);
    }
    SECTION("unless asked for") {
        scene.parameters["walls"] = string("particles");
    }
    SECTION("by themselves") {
        scene.parameters.erase("walls");
    }
    REQUIRE_FALSE(scene.start().fault);
    CHECK(walls_of(scene).find("integrals") == string::npos);
}

TEST_CASE("IntegralScenes.ChangeTheirWallsWhileRunning") {
    Scene scene = with_integrals(make_tank(2, 24));
    REQUIRE_FALSE(scene.start().fault);
    REQUIRE_FALSE(scene.step().fault);
    REQUIRE_FALSE(scene.model->set_parameters({{"walls", string("particles")}}));
    REQUIRE_FALSE(scene.step().fault);
    CHECK(walls_of(scene).find("integrals") == string::npos);
    REQUIRE_FALSE(scene.model->set_parameters({{"walls", string("integrals")}}));
    REQUIRE_FALSE(scene.step().fault);
    CHECK(is_without_dummies(scene));
}
