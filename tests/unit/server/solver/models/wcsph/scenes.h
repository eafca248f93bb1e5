// Small scenes of the wcsph model for its tests.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "../../fixtures.h"
#include "server/solver/diagnostics.h"
#include "server/solver/models/registry.h"
#include "server/solver/parallel.h"

namespace headrace::solver::testing {

// Particles, walls, model and clock in one.
struct Scene {
    int dimensions{2};
    double dx{0.05};  // [m]
    Domain domain{{-10, -10, -10}, {10, 10, 10}};
    std::vector<CollisionObject> objects;
    std::optional<BodyForce> body_force;
    ParameterMap parameters;
    Particles particles;
    std::unique_ptr<Model> model;
    double time{0.0};  // [s]
    std::uint64_t objects_version{1};

    Surroundings surroundings() const {
        return {objects, domain, time, body_force ? &*body_force : nullptr, objects_version};
    }
    StepReport start() {
        // Laws are checked to round-off; what single precision does to them has tests of its own.
        ParameterMap chosen = parameters;
        chosen.try_emplace("precision", std::string("double"));
        model = make_model("wcsph", dimensions, dx, chosen);
        time = 0.0;
        return model->initialise(particles, surroundings());
    }
    StepReport step() {
        StepReport report = model->step(particles, surroundings());
        time += report.dt;
        return report;
    }
    void steps(int count) {
        for (int k = 0; k < count; ++k) step();
    }
};

inline void displace_randomly(Particles& particles, double most, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-most, most);
    for (int k = 0; k < particles.dimensions; ++k) {
        for (double& x : particles.x[k]) x += uniform(random);
    }
}

// v and p in +-1 m/s and +-`pressure`.
inline void set_random_state(Particles& particles, double pressure, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int k = 0; k < particles.dimensions; ++k) {
        for (double& v : particles.v[k]) v = uniform(random);
    }
    for (double& p : particles.p) p = pressure * uniform(random);
}

// A disc or ball of radius 1 m about the origin, stretched by the strain rate 1/s; no gravity, nothing around it.
inline Scene make_drop(int dimensions, int across, double jitter = 0.0) {
    Scene scene;
    scene.dimensions = dimensions;
    scene.dx = 2.0 / across;
    std::vector<Vec3> points;
    for (const Vec3& x : lattice({across, across, dimensions == 3 ? across : 1}, scene.dx, {-1, -1, -1})) {
        const double z = dimensions == 3 ? x[2] : 0.0;
        if (x[0] * x[0] + x[1] * x[1] + z * z < 1.0) points.push_back(x);
    }
    scene.particles = make_particles(dimensions, points);
    displace_randomly(scene.particles, jitter * scene.dx, 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
        scene.particles.v[0][i] = scene.particles.x[0][i];
        scene.particles.v[1][i] = -scene.particles.x[1][i];
    }
    scene.parameters = {{"gravity", Vec3{}}, {"sound_speed", 20.0}};
    return scene;
}

// Water 1 m wide and `height` deep in a box with its corner at the origin, `across` particles wide, under the pressure
// of still water.
inline Scene make_tank(int dimensions, int across, double height = 0.5) {
    Scene scene;
    scene.dimensions = dimensions;
    scene.dx = 1.0 / across;
    scene.domain = {{-0.5, -0.5, -0.5}, {1.5, 2.5, 1.5}};
    const double depth = dimensions == 3 ? 0.5 : 1.0;
    scene.objects = {{"tank", Role::container, Box{{0.5, 1.0, 0.5 * depth}, {0.5, 1.0, 0.5 * depth}}}};
    const int up = static_cast<int>(std::lround(height / scene.dx));
    scene.particles =
        make_particles(dimensions, lattice({across, up, dimensions == 3 ? across / 2 : 1}, scene.dx, {0.0, 0.0, 0.0}));
    constexpr double c0 = 30.0, g = 9.81;
    scene.parameters = {{"sound_speed", c0}};
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const double d = g * (height - scene.particles.x[1][i]);
        scene.particles.p[i] = 1000.0 * c0 * c0 * std::expm1(d / (c0 * c0));
    }
    return scene;
}

// A doubly periodic unit square of fluid, `across` particles wide.
inline Scene make_periodic_square(int across, double jitter = 0.0) {
    Scene scene;
    scene.dx = 1.0 / across;
    scene.domain = {{0, 0, -1}, {1, 1, 1}, {true, true, false}};
    scene.particles = make_particles(2, lattice({across, across, 1}, scene.dx));
    displace_randomly(scene.particles, jitter * scene.dx, 5);
    scene.parameters = {{"gravity", Vec3{}}, {"free_surface", false}, {"sound_speed", 10.0}};
    return scene;
}

inline double kinetic_energy(const Particles& particles) {
    double sum = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (int k = 0; k < particles.dimensions; ++k)
            sum += 0.5 * particles.m[i] * particles.v[k][i] * particles.v[k][i];
    }
    return sum;
}

// sum of m u, and of its magnitudes.
struct VectorSum {
    Vec3 sum{};
    double size{};
};
inline VectorSum sum_over(const Particles& particles, const VectorField& u) {
    VectorSum total;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (int k = 0; k < particles.dimensions; ++k) {
            total.sum[k] += particles.m[i] * u[k][i];
            total.size += std::abs(particles.m[i] * u[k][i]);
        }
    }
    return total;
}

inline double length_of(const Vec3& u) {
    return std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
}

// Runs `work` with this many threads.
template <class Work>
void with_threads(int threads, Work&& work) {
    const int before = max_threads();
    omp_set_num_threads(threads);
    work();
    omp_set_num_threads(before);
}

}  // namespace headrace::solver::testing
