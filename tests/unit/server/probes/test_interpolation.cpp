#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "server/probes/interpolation.h"
#include "tests/unit/server/probes/fixtures.h"

using namespace headrace;
using namespace headrace::test;
using probes::NearParticle;

namespace {

// Value at x of a field given by a formula at the particles; nothing where no fluid is in reach.
std::optional<double> interpolate(const solver::Particles& particles, double R, const Vec3& x,
                                  const std::function<double(const Vec3&)>& field) {
    std::vector<probes::Region> regions{{x, x, R}};
    const auto near = probes::find_nearby(particles, {{-100, -100, -100}, {100, 100, 100}, {}}, regions)[0];
    std::vector<double> weights;
    if (!probes::make_weights(particles.dimensions, R, x, near, weights)) return std::nullopt;
    double sum = 0.0;
    for (std::size_t j = 0; j < near.size(); ++j) sum += weights[j] * field(near[j].x);
    return sum;
}

double linear(const Vec3& x) {
    return 3.0 - 7.0 * x[0] + 11.0 * x[1] + 5.0 * x[2];
}

}  // namespace

TEST_CASE("ProbeKernel.IntegratesToOne") {
    // Midpoint rule with 400 shells: its error is of order 1/400^2.
    constexpr int kShells = 400;
    const double R = 0.3;
    double line = 0.0, disc = 0.0, ball = 0.0;
    for (int k = 0; k < kShells; ++k) {
        const double r = (k + 0.5) / kShells * R, dr = R / kShells;
        line += 2.0 * probes::wendland_c2_line(R, r) * dr;
        disc += 2.0 * std::numbers::pi * r * probes::wendland_c2(2, R, r) * dr;
        ball += 4.0 * std::numbers::pi * r * r * probes::wendland_c2(3, R, r) * dr;
    }
    CHECK(line == Approx(1.0).epsilon(1e-4));
    CHECK(disc == Approx(1.0).epsilon(1e-4));
    CHECK(ball == Approx(1.0).epsilon(1e-4));
    CHECK(probes::wendland_c2(3, R, R) == 0.0);
}

TEST_CASE("ProbeInterpolation.LinearFieldsAreExactOnDisorderedParticles") {
    const int dimensions = GENERATE(2, 3);
    const unsigned seed = 20260102;
    INFO("dimensions " << dimensions << ", seed " << seed);
    const double dx = 0.05;
    const auto particles = make_box(dimensions, dx, {0, 0, 0}, {1, 1, 1}, 0.3, seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.0, 1.0);
    for (int k = 0; k < 20; ++k) {
        // Anywhere in the box, on its sides too: there half of the support is empty.
        Vec3 x{place(random), place(random), dimensions == 3 ? place(random) : 0.0};
        if (k % 3 == 1) x[1] = 0.0;
        if (k % 3 == 2) x[0] = 1.0;
        const auto value = interpolate(particles, 3.0 * dx, x, linear);
        REQUIRE(value);
        // Rounding alone: values of up to 20, a hundred terms, a system of 3 with condition of about 100.
        CHECK(*value == Approx(linear(x)).margin(1e-11));
    }
}

// The limit of the amplification must not cut into what it is made for: flat walls and corners, for all usual supports.
TEST_CASE("ProbeInterpolation.ReachesIntoCornersExactly") {
    const double support = GENERATE(2.0, 2.4, 3.0, 4.0);
    const double dx = 0.05;
    INFO("support " << support << " spacings");
    const auto flat = make_box(2, dx, {0, 0, 0}, {1, 1, 0});
    const auto deep = make_box(3, dx, {0, 0, 0}, {1, 1, 1});
    CHECK(*interpolate(flat, support * dx, {0.5, 0, 0}, linear) == Approx(linear({0.5, 0, 0})).margin(1e-11));
    CHECK(*interpolate(flat, support * dx, {0, 0, 0}, linear) == Approx(linear({0, 0, 0})).margin(1e-11));
    CHECK(*interpolate(deep, support * dx, {0.5, 0.5, 1}, linear) == Approx(linear({0.5, 0.5, 1})).margin(1e-11));
    CHECK(*interpolate(deep, support * dx, {0, 0, 0}, linear) == Approx(linear({0, 0, 0})).margin(1e-11));
}

TEST_CASE("ProbeInterpolation.FarFromAFewParticlesTheirMeanIsTaken") {
    const double dx = 0.05;
    // One particle: there is no gradient to know.
    const auto alone = make_box(2, dx, {0, 0, 0}, {dx, dx, 0});
    REQUIRE(alone.size() == 1);
    const auto value = interpolate(alone, 3 * dx, {0.1, 0.02, 0}, linear);
    REQUIRE(value);
    CHECK(*value == Approx(linear({0.025, 0.025, 0})));

    // Far outside a fluid with a steep gradient the value stays within what the particles have.
    const auto fluid = make_box(2, dx, {0, 0, 0}, {1, 0.5, 0}, 0.2);
    const auto outside = interpolate(fluid, 3 * dx, {0.5, 0.5 + 2.2 * dx, 0}, [](const Vec3& x) { return 1e4 * x[1]; });
    REQUIRE(outside);
    CHECK(*outside <= 1e4 * 0.5);
    CHECK(*outside >= 1e4 * 0.4);
}

TEST_CASE("ProbeInterpolation.OutOfReachThereIsNothing") {
    const double dx = 0.05;
    const auto fluid = make_box(2, dx, {0, 0, 0}, {0.5, 0.5, 0});
    // The last row stands half a spacing below the side.
    CHECK(interpolate(fluid, 3 * dx, {0.25, 0.5 + 2.4 * dx, 0}, linear));
    CHECK_FALSE(interpolate(fluid, 3 * dx, {0.25, 0.5 + 2.6 * dx, 0}, linear));
}

TEST_CASE("ProbeNearby.MatchesAllPairsAndContinuesPeriodicAxes") {
    const int dimensions = GENERATE(2, 3);
    const unsigned seed = 77;
    INFO("dimensions " << dimensions << ", seed " << seed);
    // More than one block of particles, in an order that has nothing to do with place.
    auto particles = make_box(dimensions, dimensions == 2 ? 0.02 : 0.06, {0, 0, 0}, {1, 1, 1}, 0.3, seed);
    std::mt19937 random(seed);
    for (std::size_t i = particles.size() - 1; i > 0; --i) {
        const std::size_t j = random() % (i + 1);
        for (int k = 0; k < dimensions; ++k) std::swap(particles.x[k][i], particles.x[k][j]);
    }
    solver::Domain domain{{0, 0, 0}, {1, 1, 1}, {true, false, false}};
    for (auto& x : particles.x[0]) x -= std::floor(x);
    const std::vector<probes::Region> regions{{{0.02, 0.5, 0.5}, {0.02, 0.5, 0.5}, 0.15},
                                              {{0.1, 0.1, 0.2}, {0.8, 0.9, 0.7}, 0.1}};
    const auto near = probes::find_nearby(particles, domain, regions);
    REQUIRE(near.size() == 2);
    CHECK(near[0].size() > 10);

    for (std::size_t r = 0; r < regions.size(); ++r) {
        std::vector<std::pair<std::size_t, double>> expected;  // slot, x of the image
        for (std::size_t i = 0; i < particles.size(); ++i)
            for (const double shift : {-1.0, 0.0, 1.0}) {
                Vec3 x = position(particles, i);
                x[0] += shift;
                // Nearest of many points of the line: the distance is right to 1e-6 of the reach.
                double nearest = 1e9;
                for (int k = 0; k <= 2000; ++k) {
                    double d2 = 0.0;
                    for (int axis = 0; axis < dimensions; ++axis) {
                        const double at = regions[r].a[axis] + k / 2000.0 * (regions[r].b[axis] - regions[r].a[axis]);
                        d2 += (x[axis] - at) * (x[axis] - at);
                    }
                    nearest = std::min(nearest, std::sqrt(d2));
                }
                if (nearest < regions[r].reach) expected.emplace_back(i, x[0]);
            }
        std::vector<std::pair<std::size_t, double>> found;
        for (const NearParticle& particle : near[r]) found.emplace_back(particle.slot, particle.x[0]);
        std::sort(found.begin(), found.end());
        std::sort(expected.begin(), expected.end());
        CHECK(found == expected);
    }
    CHECK(probes::find_nearby(particles, domain, {}).empty());
}
