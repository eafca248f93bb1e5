#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "server/solver/eos.h"
#include "server/solver/kernels.h"
#include "server/solver/parallel.h"
#include "tests/bench/strategy_sums.h"
#include "tests/unit/server/solver/fixtures.h"

using namespace headrace;
using namespace headrace::solver::testing;
using bench::Strategy;
using solver::Index;

namespace {

const double s = kThesisSpacing;  // [m]
constexpr Strategy kStrategies[] = {Strategy::all_pairs, Strategy::linked_cells, Strategy::symmetry,
                                    Strategy::coloured_layers, Strategy::simd};

solver::ThesisParameters parameters_with(int dimensions, double support_over_dp) {
    return solver::make_thesis_parameters(dimensions, s, {{"support_radius", support_over_dp * s}});
}

// A lattice around the origin, so that cells have negative numbers too, jittered by up to 0.2 spacings, with random
// velocities up to 0.2 m/s.
solver::Particles jittered_block(int dimensions, const std::array<int, 3>& n, unsigned seed) {
    std::vector<solver::Vec3> x = lattice(n, s, {-0.5 * n[0] * s, -0.5 * n[1] * s, -0.5 * n[2] * s});
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-0.2, 0.2);
    for (solver::Vec3& point : x)
        for (double& component : point) component += s * uniform(random);
    solver::Particles particles = make_particles(dimensions, x);
    for (int k = 0; k < dimensions; ++k)
        for (double& component : particles.v[k]) component = uniform(random);
    return particles;
}

// The model's own sums: the judge.
SumBench make_judge(const solver::Particles& particles, const solver::ThesisParameters& parameters) {
    SumBench judge(particles, parameters);
    judge.compute_density();
    for (std::size_t i = 0; i < judge.particles.size(); ++i)
        judge.particles.p[i] =
            solver::linear_pressure(judge.particles.rho[i], parameters.rest_density, parameters.stiffness);
    judge.compute_acceleration({});
    return judge;
}

// rho and a of every particle, in storage order.
struct Outcome {
    std::vector<double> rho;
    std::vector<double> a;
};

Outcome run_strategy(Strategy strategy, const SumBench& judge) {
    const int dimensions = judge.particles.dimensions;
    const std::size_t count = judge.particles.size();
    const auto sums = bench::make_strategy_sums(strategy, dimensions, solver::best_isa());
    Outcome outcome{std::vector<double>(count), std::vector<double>(dimensions * count)};
    sums->compute_density(judge.input(), outcome.rho.data());
    std::array<double*, 3> a{};
    for (int k = 0; k < dimensions; ++k) a[k] = outcome.a.data() + k * count;
    sums->compute_acceleration(judge.input(), a);
    return outcome;
}

double distance(const solver::Particles& particles, std::size_t i, std::size_t j) {
    double r2 = 0.0;
    for (int k = 0; k < particles.dimensions; ++k) r2 += std::pow(particles.x[k][i] - particles.x[k][j], 2);
    return std::sqrt(r2);
}

// By how much two orders of the same additions may differ. n terms of magnitude t, each of some 20 roundings (with or
// without fused multiply-adds, and with 1/rho in or outside the sum), give at most (n + 20) n t eps. Terms are largest
// where r = 0, but for differences of velocity.
struct Tolerance {
    double rho{}, a{};
};

template <int D>
Tolerance find_tolerance(const SumBench& judge) {
    const solver::Particles& particles = judge.particles;
    const solver::ThesisParameters& parameters = judge.parameters;
    const double h = parameters.support_radius;
    double n = 0.0, p = 0.0, v = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        double neighbours = 0.0;
        for (std::size_t j = 0; j < particles.size(); ++j) neighbours += distance(particles, i, j) < h;
        n = std::max(n, neighbours);
        p = std::max(p, std::abs(particles.p[i]));
        for (int k = 0; k < D; ++k) v = std::max(v, std::abs(particles.v[k][i]));
    }
    const double rho = *std::min_element(particles.rho.begin(), particles.rho.end());
    const double V = parameters.particle_mass / rho;
    const solver::Poly6<D> poly6(h);
    const double rounding = (n + 20.0) * n * std::numeric_limits<double>::epsilon();

    const double f = V * (p * std::abs(solver::Spiky<D>(h).slope(0.0)) +
                          2.0 * v * parameters.viscosity * solver::ViscosityKernel<D>(h).laplacian(0.0));
    // f_s = -sigma laplacian_c n/|n|: |n| is the threshold at least, and n's components are off by that much each
    const double laplacian_c = V * std::abs(poly6.laplacian(0.0));
    const double gradient_c = V * std::abs(poly6.gradient_factor(0.0)) * h;
    const double f_s = parameters.surface_tension * laplacian_c *
                       (1.0 + 2.0 * n * std::sqrt(D) * gradient_c / parameters.surface_tension_threshold);
    return {rounding * parameters.particle_mass * poly6.W(0.0), rounding * (f + f_s) / rho};
}

template <int D>
void check_strategies(const std::array<int, 3>& n, double support_over_dp, unsigned seed) {
    CAPTURE(D, support_over_dp, seed);
    const SumBench judge = make_judge(jittered_block(D, n, seed), parameters_with(D, support_over_dp));
    const Tolerance tolerance = find_tolerance<D>(judge);
    // Small enough to tell: an average neighbour gives some thousandths of rho, and 0.01 m/s^2 or more.
    REQUIRE(tolerance.rho < 1e-6 * judge.parameters.rest_density);
    REQUIRE(tolerance.a < 1e-5);
    for (const Strategy strategy : kStrategies) {
        CAPTURE(bench::strategy_name(strategy));
        const Outcome outcome = run_strategy(strategy, judge);
        const std::size_t count = judge.particles.size();
        double worst_rho = 0.0, worst_a = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            worst_rho = std::max(worst_rho, std::abs(outcome.rho[i] - judge.particles.rho[i]));
            for (int k = 0; k < D; ++k)
                worst_a = std::max(worst_a, std::abs(outcome.a[k * count + i] - judge.particles.a[k][i]));
        }
        CHECK(worst_rho <= tolerance.rho);
        CHECK(worst_a <= tolerance.a);
    }
}

bool has_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// visit(layer, i, j) for the pairs of the half neighbourhoods, colour by colour; `begin_colour` before each.
template <class BeginColour, class Visit>
void visit_coloured_pairs(const solver::CellGrid& grid, int dimensions, BeginColour&& begin_colour, Visit&& visit) {
    for (const auto& layers : bench::find_coloured_layers(grid, dimensions)) {
        begin_colour();
        for (std::size_t layer = 0; layer < layers.size(); ++layer) {
            for (std::size_t c = layers[layer].first; c < layers[layer].last; ++c) {
                const solver::Run cell = grid.cell(c);
                for (Index i = cell.begin; i < cell.end; ++i)
                    bench::for_each_later(grid.around(c), i, [&](Index j) { visit(static_cast<int>(layer), i, j); });
            }
        }
    }
}

void check_pairs(const solver::Particles& unsorted, double support) {
    solver::Particles particles = unsorted;
    solver::CellGrid grid;
    grid.sort(particles, support);
    const std::size_t count = particles.size();
    std::vector<int> meetings(count * count);
    // Which layer wrote a particle, colour by colour: no other of that colour may.
    std::vector<int> writer(count);
    bool is_shared = false;
    const auto write = [&](int layer, Index i) {
        is_shared = is_shared || (writer[i] >= 0 && writer[i] != layer);
        writer[i] = layer;
    };
    visit_coloured_pairs(
        grid, particles.dimensions, [&] { writer.assign(count, -1); },
        [&](int layer, Index i, Index j) {
            write(layer, i);
            write(layer, j);
            ++meetings[std::min(i, j) * count + std::max(i, j)];
        });
    std::size_t missed = 0, repeated = 0, neighbours = 0;
    for (std::size_t i = 0; i < count; ++i) {
        repeated += meetings[i * count + i] > 0;  // with itself
        for (std::size_t j = i + 1; j < count; ++j) {
            const bool is_near = distance(particles, i, j) < support;
            neighbours += is_near;
            missed += is_near && meetings[i * count + j] == 0;
            repeated += meetings[i * count + j] > 1;
        }
    }
    CHECK(neighbours > count);
    CHECK(missed == 0);
    CHECK(repeated == 0);
    CHECK_FALSE(is_shared);
}

}  // namespace

TEST_CASE("StrategySums.EqualTheModelsOwn") {
    check_strategies<3>({11, 9, 12}, 1.68, 1);
    check_strategies<3>({8, 9, 10}, 3.0, 2);
    check_strategies<2>({32, 25, 1}, 2.5, 3);
}

TEST_CASE("StrategySums.HalfNeighbourhoodMeetsEveryPairOnceAndLayersOfAColourShareNoParticle") {
    check_pairs(jittered_block(3, {10, 9, 12}, 4), 1.68 * s);
    check_pairs(jittered_block(3, {9, 9, 10}, 5), 3.0 * s);
    check_pairs(jittered_block(2, {30, 35, 1}, 6), 2.5 * s);
}

TEST_CASE("StrategySums.HalfNeighbourhoodMeetsEveryPairOnceAcrossGaps") {
    // Empty layers between: neighbours in the list of layers need not be neighbours in space.
    solver::Particles particles = jittered_block(3, {8, 8, 15}, 7);
    for (double& z : particles.x[2]) z += z > 2 * s ? 7.3 * s : z > 0 ? 3.1 * s : 0.0;
    check_pairs(particles, 1.68 * s);
    // so far that cells are found by bisection
    for (double& z : particles.x[2]) z += z > 2 * s ? 3e4 * s : 0.0;
    check_pairs(particles, 1.68 * s);
}

TEST_CASE("StrategySums.HaveTheSameBitsForAnyThreadCount") {
    const int before = solver::max_threads();
    // some 18 layers of cells: several of a colour for every thread
    const SumBench judge = make_judge(jittered_block(3, {12, 12, 30}, 8), parameters_with(3, 1.68));
    for (const Strategy strategy : kStrategies) {
        if (!bench::is_parallel(strategy)) continue;
        CAPTURE(bench::strategy_name(strategy));
        omp_set_num_threads(1);
        const Outcome one = run_strategy(strategy, judge);
        for (const int threads : {2, 3, 4}) {
            omp_set_num_threads(threads);
            const Outcome many = run_strategy(strategy, judge);
            CHECK(has_same_bits(many.rho, one.rho));
            CHECK(has_same_bits(many.a, one.a));
        }
    }
    omp_set_num_threads(before);
}
