#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>

#include "fixtures.h"
#include "server/solver/diagnostics.h"
#include "server/solver/parallel.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

Particles make_cloud(unsigned seed) {
    Particles particles = make_particles(3, random_points(5000, 1.0, seed));
    particles.v = particles.x;
    particles.v_half = particles.x;
    particles.m.assign(particles.size(), 0.02);
    for (std::size_t i = 0; i < particles.size(); ++i) particles.rho[i] = 1000.0 + static_cast<double>(i % 7);
    return particles;
}

}  // namespace

TEST_CASE("Diagnostics.ValuesByHand") {
    Particles particles = make_particles(3, {{1.0, 2.0, 3.0}, {0.0, -1.0, 0.0}});
    particles.v[0] = {3.0, 0.0};
    particles.v[1] = {4.0, 1.0};
    particles.rho = {900.0, 1100.0};
    particles.m = {0.5, 0.4};
    const Diagnostics found = compute_diagnostics(particles, {0.0, -10.0, 0.0});
    CHECK(found.max_speed == 5.0);
    CHECK(found.kinetic_energy == Approx(0.5 * (0.5 * 25.0 + 0.4 * 1.0)));
    CHECK(found.potential_energy == Approx(10.0 * (0.5 * 2.0 - 0.4 * 1.0)));
    CHECK(found.mean_density == 1000.0);
    CHECK(found.max_density == 1100.0);
    CHECK(compute_slow_share(particles, 5.0) == 0.5);
    CHECK(compute_slow_share(particles, 5.1) == 1.0);
    CHECK(compute_slow_share(particles, 0.5) == 0.0);
}

TEST_CASE("Diagnostics.EmptySceneIsAtRest") {
    const Particles none = make_particles(3, {});
    CHECK(compute_diagnostics(none, {}).mean_density == 0.0);
    CHECK(compute_slow_share(none, 0.1) == 1.0);
    CHECK(compute_state_hash(none) == 0);
}

TEST_CASE("Diagnostics.SameBitsForAnyThreadCount") {
    const Particles particles = make_cloud(3);
    const int before = max_threads();
    omp_set_num_threads(1);
    const Diagnostics one = compute_diagnostics(particles, {0.1, -9.82, 0.3});
    for (const int threads : {2, 3, 4}) {
        omp_set_num_threads(threads);
        const Diagnostics many = compute_diagnostics(particles, {0.1, -9.82, 0.3});
        CHECK(many.kinetic_energy == one.kinetic_energy);
        CHECK(many.potential_energy == one.potential_energy);
        CHECK(many.mean_density == one.mean_density);
    }
    omp_set_num_threads(before);
}

TEST_CASE("StateHash.FollowsItsDefinition") {
    Particles particles = make_particles(2, {{0.25, -1.5, 0.0}});
    particles.id[0] = 7;
    particles.v_half[0] = {2.0};
    particles.v_half[1] = {-0.0};
    const auto mix = [](std::uint64_t z) {
        z += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    };
    std::uint64_t s = 7;
    for (const double word : {0.25, -1.5, 2.0, -0.0}) s = mix(s ^ std::bit_cast<std::uint64_t>(word));
    CHECK(compute_state_hash(particles) == mix(s));
}

TEST_CASE("StateHash.IgnoresStorageOrderAndSeesEveryBit") {
    Particles particles = make_cloud(5);
    const std::uint64_t hash = compute_state_hash(particles);
    CellGrid().sort(particles, 0.1);
    CHECK(compute_state_hash(particles) == hash);
    particles.x[2][17] = std::nextafter(particles.x[2][17], 10.0);
    CHECK(compute_state_hash(particles) != hash);
}
