#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "scenes.h"
#include "server/solver/models/wcsph/sound_speed.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

constexpr double kSigma = 2.0;  // [N/m]

// A disc or ball of radius 1 m in shells a spacing apart, each evenly covered: its surface has no steps.
Scene make_shells(int dimensions, int shells) {
    Scene scene;
    scene.dimensions = dimensions;
    scene.dx = 1.0 / shells;
    std::vector<Vec3> points;
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (int shell = 0; shell < shells; ++shell) {
        const double r = (shell + 0.5) * scene.dx;
        const double volume = dimensions == 2 ? std::numbers::pi * (2 * shell + 1)
                                              : 4.0 / 3.0 * std::numbers::pi * (3 * shell * shell + 3 * shell + 1);
        const int count = std::max(1, static_cast<int>(std::lround(volume)));  // [dx^D]
        for (int k = 0; k < count; ++k) {
            if (dimensions == 2) {
                const double angle = 2.0 * std::numbers::pi * (k + 0.5 * (shell % 2)) / count;
                points.push_back({r * std::cos(angle), r * std::sin(angle), 0.0});
            } else {
                const double z = 1.0 - (2.0 * k + 1.0) / count, ring = std::sqrt(1.0 - z * z);
                points.push_back({r * ring * std::cos(golden * k), r * ring * std::sin(golden * k), r * z});
            }
        }
    }
    scene.particles = make_particles(dimensions, points);
    scene.parameters = {{"gravity", Vec3{}}, {"sound_speed", 20.0}};
    return scene;
}

// At rest without pressure, so that tension is its only acceleration. The ellipse or ellipsoid of the semi-axes
// (e^l, e^-l) or (e^(-l/2), e^(-l/2), e^l) radii.
Scene make_stretched_drop(int dimensions, int shells, double l) {
    Scene scene = make_shells(dimensions, shells);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        for (int k = 0; k < dimensions; ++k) {
            const double share = dimensions == 2 ? (k == 0 ? 1.0 : -1.0) : (k == 2 ? 1.0 : -0.5);
            scene.particles.x[k][i] *= std::exp(share * l);
        }
    }
    scene.parameters["surface_tension"] = kSigma;
    REQUIRE_FALSE(scene.start().fault);
    return scene;
}

// Work of tension per unit of l: -sigma d(surface)/dl.
double work_of_stretch(const Scene& scene) {
    const Particles& particles = scene.particles;
    double work = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (int k = 0; k < scene.dimensions; ++k) {
            const double share = scene.dimensions == 2 ? (k == 0 ? 1.0 : -1.0) : (k == 2 ? 1.0 : -0.5);
            work += particles.m[i] * particles.a[k][i] * share * particles.x[k][i];
        }
    }
    return work;
}

}  // namespace

TEST_CASE("WcsphTension.DiscPullsBackAsItsCircumferenceGrows") {
    const double l = 0.1;
    const Scene scene = make_stretched_drop(2, 20, l);
    const double R = std::sqrt(static_cast<double>(scene.particles.size()) / std::numbers::pi) * scene.dx;
    // The circumference is 2 pi R (1 + 3 l^2/4 + O(l^4)).
    CAPTURE(work_of_stretch(scene) / (-kSigma * 3.0 * std::numbers::pi * R * l));
    CHECK(work_of_stretch(scene) == Approx(-kSigma * 3.0 * std::numbers::pi * R * l).epsilon(0.05));
}

TEST_CASE("WcsphTension.BallPullsBackAsItsSurfaceGrows") {
    const double l = 0.1;
    const Scene longer = make_stretched_drop(3, 12, l), shorter = make_stretched_drop(3, 12, -l);
    const double volume = static_cast<double>(longer.particles.size()) * std::pow(longer.dx, 3);
    const double R = std::cbrt(0.75 * volume / std::numbers::pi);
    // The surface is 4 pi R^2 + 8 pi/5 R^2 l^2 + O(l^3); the cubic part leaves the difference of the two.
    const double work = 0.5 * (work_of_stretch(longer) - work_of_stretch(shorter));
    CAPTURE(work / (-kSigma * 16.0 * std::numbers::pi / 5.0 * R * R * l));
    CHECK(work == Approx(-kSigma * 16.0 * std::numbers::pi / 5.0 * R * R * l).epsilon(0.05));
}

TEST_CASE("WcsphTension.FlatSurfaceIsNotPulledAlong") {
    for (const char* form : {"continuum", "thesis"}) {
        Scene scene = make_periodic_square(20);
        scene.domain.periodic[1] = false;
        scene.domain.min[1] = -1.0;
        scene.domain.max[1] = 2.0;
        scene.parameters["free_surface"] = true;
        scene.parameters["surface_tension"] = kSigma;
        scene.parameters["tension_form"] = std::string(form);
        REQUIRE_FALSE(scene.start().fault);
        // 1e-9 of sigma/(rho dx^2): terms that cancel by symmetry
        for (const double a : scene.particles.a[0]) CHECK(std::abs(a) < 1e-9 * kSigma / (1000.0 * scene.dx * scene.dx));
    }
}

TEST_CASE("WcsphTension.DisorderedDropIsNotPushedAsAWhole") {
    for (const int dimensions : {2, 3}) {
        Scene scene = make_drop(dimensions, dimensions == 2 ? 24 : 12, 0.2);
        for (int k = 0; k < dimensions; ++k) std::fill(scene.particles.v[k].begin(), scene.particles.v[k].end(), 0.0);
        scene.parameters["surface_tension"] = kSigma;
        REQUIRE_FALSE(scene.start().fault);
        const VectorSum force = sum_over(scene.particles, scene.particles.a);
        REQUIRE(force.size > 0.0);
        CHECK(length_of(force.sum) < 1e-12 * force.size);  // rounding
    }
}

TEST_CASE("WcsphTension.FluidIsStiffEnoughForItsSurface") {
    // The stress along the surface, about sigma over a layer of one spacing, is 1 % of rho0 c0^2.
    WcsphParameters parameters;
    parameters.gravity = {};
    parameters.surface_tension = 1e6;
    const Scene scene = make_drop(2, 20);
    const double c0 = choose_sound_speed(parameters, scene.particles, scene.dx, 0.0);
    CHECK(1e6 / scene.dx == Approx(0.01 * 1000.0 * c0 * c0));
}
