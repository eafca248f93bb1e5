#include <catch2/catch.hpp>

#include "../fixtures.h"
#include "server/solver/kernels.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

TEST_CASE("Density.LoneParticleCountsItself") {
    SumBench bench(make_particles(3, {{0.1, 0.2, 0.3}}), weightless(3));
    bench.compute_density();
    CHECK(bench.particles.rho[0] == Approx(0.02 * Poly6<3>(0.0457).W(0.0)).epsilon(1e-13));
}

TEST_CASE("Density.ThesisLatticeHas961") {
    // an independent double-precision run gives about 961 kg/m^3 on the lattice of spacing (m/rho0)^(1/3); the sum is
    // exact, 1 covers "about"
    SumBench bench(make_particles(3, lattice({9, 9, 9}, kThesisSpacing)), weightless(3));
    bench.compute_density();
    CHECK(bench.particles.rho[slot_of(bench.particles, 364)] == Approx(961.0).margin(1.0));
}

TEMPLATE_TEST_CASE_SIG("Density.MatchesAllPairs", "", ((int D), D), 2, 3) {
    const unsigned seed = 9;
    INFO("seed " << seed);
    SumBench bench(make_particles(D, random_points(400, 0.3, seed, D)), weightless(D));
    bench.compute_density();
    const Poly6<D> poly6(bench.parameters.support_radius);
    const Particles& particles = bench.particles;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        double sum = 0.0;
        for (std::size_t j = 0; j < particles.size(); ++j) {
            double r2 = 0.0;
            for (int k = 0; k < D; ++k) r2 += std::pow(particles.x[k][i] - particles.x[k][j], 2);
            sum += poly6.W(r2);
        }
        CHECK(particles.rho[i] == Approx(bench.parameters.particle_mass * sum).epsilon(1e-12));  // rounding
    }
}
