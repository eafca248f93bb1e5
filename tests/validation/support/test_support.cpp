// The measures by hand values, and the cases as documents.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/validation/support/case.h"
#include "tests/validation/support/leaks.h"
#include "tests/validation/support/measures.h"
#include "tests/validation/support/reference_data.h"

using namespace headrace;
using namespace headrace::validation;

namespace {

solver::Particles make_lattice(int across, double dx) {
    solver::Particles particles;
    particles.dimensions = 2;
    particles.resize(static_cast<std::size_t>(across * across));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        particles.id[i] = static_cast<solver::Index>(i);
        particles.x[0][i] = (static_cast<int>(i) % across + 0.5) * dx;
        particles.x[1][i] = (static_cast<int>(i) / across + 0.5) * dx;
        particles.m[i] = 1000.0 * dx * dx;
        particles.rho[i] = 1000.0;
    }
    return particles;
}

}  // namespace

TEST_CASE("ValidationScenes.AreTheFirstCaseOfTheirFolderAtItsTarget") {
    std::string folder;
    for (const Case& one : cases()) {
        if (one.folder == folder) continue;  // variants are made from the first
        folder = one.folder;
        INFO(one.name);
        const auto written = load_scene(one);
        REQUIRE(written.ok());
        proto::SceneDesc made = *written;
        made.spacing = one.length / one.resolution;
        if (one.adapt) one.adapt(made, one.resolution);
        CHECK(made.spacing == Approx(written->spacing).epsilon(1e-12));  // printed to 16 digits
        CHECK(made.parameters == written->parameters);
        if (const auto* disc = std::get_if<proto::SphereDesc>(&written->fluids.front().shape))
            CHECK(std::get<proto::SphereDesc>(made.fluids.front().shape).radius == Approx(disc->radius).epsilon(1e-12));
    }
}

TEST_CASE("ValidationCases.HaveTargetsAmongTheirMetricsNamesOnce") {
    for (const Case& one : cases()) {
        CHECK(find_case(one.name) == &one);
        CHECK(one.resolution > 0.0);
        CHECK_FALSE(one.main_metric.empty());
        CHECK(std::is_sorted(one.ladder.begin(), one.ladder.end()));
        for (const Target& target : one.targets) CHECK(target.aim < target.must);
    }
}

TEST_CASE("RegularObserver.SamplesNextAfterNow") {
    struct Probe : RegularObserver {
        using RegularObserver::RegularObserver;
        void sample(const scene::Run&) override {}
        std::vector<Measured> measured() const override { return {}; }
    } const probe(1.0, 0.1);
    CHECK(probe.next_sample(0.0) == Approx(0.1));
    CHECK(probe.next_sample(0.25) == Approx(0.3));
    CHECK(probe.next_sample(0.1 * 3) > 0.35);  // a sample taken at its own time is not repeated
}

TEST_CASE("SemiAxis.OfAnEllipseIsItsSemiAxis") {
    solver::Particles particles = make_lattice(200, 0.01);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        particles.x[0][i] -= 1.0;
        particles.x[1][i] -= 1.0;
        const double x = particles.x[0][i] / 0.9, y = particles.x[1][i] / 0.5;
        if (x * x + y * y > 1.0) particles.m[i] = 0.0;
    }
    // A lattice knows the edge to about dx sqrt(dx/a).
    CHECK(semi_axis(particles, 0) == Approx(0.9).epsilon(2e-3));
    CHECK(semi_axis(particles, 1) == Approx(0.5).epsilon(2e-3));
}

TEST_CASE("SurfaceMode.OfAWavyColumnIsItsAmplitude") {
    solver::Particles particles = make_lattice(100, 0.01);
    const double k = 2 * std::numbers::pi, amplitude = 0.02;
    CHECK(surface_mode(particles, k, 1.0) == Approx(0.0).margin(1e-12));
    // Columns stretched to the height 1 + a cos(kx): the same mass spread over more volume.
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.rho[i] /= 1 + amplitude * std::cos(k * particles.x[0][i]);
    CHECK(surface_mode(particles, k, 1.0) == Approx(amplitude).epsilon(1e-9));
}

TEST_CASE("DampedWave.IsFoundFromSamples") {
    Series series;
    for (double t = 0.0; t < 5.0; t += 0.01) series.add(t, std::exp(-0.2 * t) * std::sin(6.3 * t) + 0.01);
    const DampedWave wave = fit_damped_wave(series, 0.5, 6.0, 0.0);
    CHECK(wave.rate == Approx(0.2).epsilon(1e-9));
    CHECK(wave.omega == Approx(6.3).epsilon(1e-9));
    CHECK(wave.offset == Approx(0.01).epsilon(1e-8));
    CHECK(wave.amplitude(0.0) == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("Series.IntegratesAndRanges") {
    Series series;
    for (int k = 0; k <= 10; ++k) series.add(k, 2.0 * k);
    CHECK(series.integral(0.5, 9.5) == Approx(9.5 * 9.5 - 0.25));
    CHECK(series.half_range(2.0, 4.0) == Approx(2.0));
    CHECK(std::isnan(series.half_range(20.0, 30.0)));
}

TEST_CASE("Interpolation.IsExactForLinearFields") {
    const solver::Particles particles = make_lattice(10, 0.1);
    std::vector<double> field;
    for (std::size_t i = 0; i < particles.size(); ++i)
        field.push_back(1 + 2 * particles.x[0][i] - 3 * particles.x[1][i]);
    const auto values = interpolate(particles, field, {{0.5, 0.5, 0}, {0.0, 1.0, 0}, {5.0, 5.0, 0}}, 0.25);
    CHECK(values[0] == Approx(0.5));
    CHECK(values[1] == Approx(-2.0));  // in a corner
    CHECK(std::isnan(values[2]));      // out of reach
}

TEST_CASE("ReferenceData.InterpolatesLinearly") {
    const std::vector<double> x{0.0, 1.0, 3.0}, y{0.0, 2.0, 0.0};
    CHECK(interpolate_linear(x, y, 0.5) == 1.0);
    CHECK(interpolate_linear(x, y, 2.0) == 1.0);
    CHECK(interpolate_linear(x, y, -1.0) == 0.0);
    CHECK(interpolate_linear(x, y, 9.0) == 0.0);
    CHECK(load_reference("no_such_folder/no_such_file.csv").empty());
}

TEST_CASE("Leaks.AreBehindASurface") {
    proto::ObjectDesc tank{"tank", proto::ObjectRole::container, proto::BoxDesc{{0, 0, 0}, {1, 2, 1}}};
    CHECK(depth_behind(tank, {0.5, 1.0, 0.5}, 3) == Approx(-0.5));
    CHECK(depth_behind(tank, {1.1, 1.0, 0.5}, 3) == Approx(0.1));
    proto::ObjectDesc ball{"ball", proto::ObjectRole::obstacle, proto::SphereDesc{{0, 0, 0}, 1.0}};
    CHECK(depth_behind(ball, {0.0, 0.4, 0.0}, 2) == Approx(0.6));
    proto::ObjectDesc floor{"floor", proto::ObjectRole::container, proto::PlaneDesc{{0, 0, 0}, {0, 2, 0}}};
    CHECK(depth_behind(floor, {3.0, 0.2, 0.0}, 2) == Approx(-0.2));
    proto::ObjectDesc pipe{"pipe", proto::ObjectRole::container, proto::CylinderDesc{{0, 0, 0}, {0, 3, 0}, 0.5}};
    CHECK(depth_behind(pipe, {0.6, 1.0, 0.0}, 3) == Approx(0.1));
    CHECK(depth_behind(pipe, {0.0, 3.2, 0.0}, 3) == Approx(0.2));
}
