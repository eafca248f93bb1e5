#include <catch2/catch.hpp>

#include "../fixtures.h"
#include "server/solver/kernels.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

constexpr ForceTerms kMean{PressureForm::mean, false, false};
constexpr ForceTerms kSymmetric{PressureForm::symmetric, false, false};

// Two particles on the x axis, 1 cm apart, of different density and pressure.
template <int D>
SumBench make_pair() {
    SumBench bench(make_particles(D, {{0.0, 0.0, 0.0}, {0.01, 0.0, 0.0}}), weightless(D));
    bench.set_state(900.0, 50.0);
    const std::size_t second = slot_of(bench.particles, 1);
    bench.particles.rho[second] = 1100.0;
    bench.particles.p[second] = 400.0;
    return bench;
}

template <int D>
double slope(const SumBench& bench) {
    return Spiky<D>(bench.parameters.support_radius).slope(0.01);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Pressure.PairHasTheValueByHand", "", ((int D), D), 2, 3) {
    SumBench bench = make_pair<D>();
    const double m = bench.parameters.particle_mass;
    // 1e-12: a handful of roundings
    bench.compute_acceleration(kMean);
    // -(p_i + p_j)/2 m/rho_j dW/dr (x_ij/r) / rho_i, x_ij/r = -1 for particle 0
    CHECK(bench.acceleration(0)[0] == Approx(225.0 * m / 1100.0 * slope<D>(bench) / 900.0).epsilon(1e-12));
    bench.compute_acceleration(kSymmetric);
    CHECK(bench.acceleration(0)[0] ==
          Approx((50.0 / (900.0 * 900.0) + 400.0 / (1100.0 * 1100.0)) * m * slope<D>(bench)).epsilon(1e-12));
}

TEST_CASE("Pressure.IsAntisymmetricAndRepelsAtPositivePressure") {
    for (const ForceTerms& terms : {kMean, kSymmetric}) {
        SumBench bench = make_pair<3>();
        bench.compute_acceleration(terms);
        CHECK(bench.acceleration(0)[0] < 0.0);
        CHECK(bench.acceleration(1)[0] == Approx(-bench.acceleration(0)[0]).epsilon(1e-13));
        CHECK(bench.acceleration(0)[1] == 0.0);
        CHECK(bench.acceleration(0)[2] == 0.0);
    }
}

TEST_CASE("Pressure.NegativePressureAttracts") {
    SumBench bench = make_pair<3>();
    bench.set_state(900.0, -10.0);
    bench.compute_acceleration(kMean);
    CHECK(bench.acceleration(0)[0] > 0.0);
}

TEST_CASE("Pressure.ConservesMomentumInACloud") {
    const unsigned seed = 3;
    INFO("seed " << seed);
    for (const ForceTerms& terms : {kMean, kSymmetric}) {
        SumBench bench(make_particles(3, random_points(300, 0.15, seed)), weightless(3));
        bench.compute_density();
        for (std::size_t i = 0; i < bench.particles.size(); ++i)
            bench.particles.p[i] = 3.0 * (bench.particles.rho[i] - 998.29);
        bench.compute_acceleration(terms);
        for (int k = 0; k < 3; ++k) {
            double sum = 0.0, size = 0.0;
            for (const double a : bench.particles.a[k]) {
                sum += a;
                size += std::abs(a);
            }
            CHECK(std::abs(sum) < 1e-12 * size);  // rounding of some ten thousand terms
        }
    }
}

TEST_CASE("Pressure.InstructionSetsAgree") {
    for (const int dimensions : {2, 3}) {
        SumBench bench(make_particles(dimensions, random_points(300, 0.15, 5, dimensions)), weightless(dimensions));
        bench.particles.v = bench.particles.x;
        bench.compute_density(Isa::baseline);
        for (std::size_t i = 0; i < bench.particles.size(); ++i)
            bench.particles.p[i] = 3.0 * (bench.particles.rho[i] - 998.29);
        const ForceTerms all{PressureForm::mean, true, true};
        bench.compute_acceleration(all, Isa::baseline);
        const Particles plain = bench.particles;
        double largest = 0.0;
        for (const double a : plain.a[0]) largest = std::max(largest, std::abs(a));
        for (int isa = 0; isa <= static_cast<int>(best_isa()); ++isa) {
            bench.compute_density(static_cast<Isa>(isa));
            bench.compute_acceleration(all, static_cast<Isa>(isa));
            // rounding only: sums of ~100 terms in another order
            for (std::size_t i = 0; i < plain.size(); ++i) {
                CHECK(bench.particles.rho[i] == Approx(plain.rho[i]).epsilon(1e-12));
                CHECK(bench.particles.a[0][i] == Approx(plain.a[0][i]).margin(1e-11 * largest));
            }
        }
    }
}
