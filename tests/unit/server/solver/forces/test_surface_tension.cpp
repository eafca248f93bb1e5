#include <catch2/catch.hpp>

#include "../fixtures.h"
#include "server/solver/forces/surface_tension.h"
#include "server/solver/kernels.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

constexpr ForceTerms kTension{PressureForm::mean, false, true};

}  // namespace

TEST_CASE("SurfaceTension.ActsFromTheThresholdOn") {
    CHECK(tension_factor(0.0728, 100.0, 49.0, 7.065) == 0.0);
    CHECK(tension_factor(0.0728, 100.0, 64.0, 7.065) == Approx(-0.0728 * 100.0 / 8.0).epsilon(1e-15));
    CHECK(tension_factor(0.0728, 100.0, 7.065 * 7.065 * (1 + 1e-12), 7.065) != 0.0);
    CHECK(tension_factor(0.0728, 100.0, 0.0, 0.0) == 0.0);  // no direction, no force
}

TEMPLATE_TEST_CASE_SIG("SurfaceTension.PairHasTheValueByHand", "", ((int D), D), 2, 3) {
    ThesisParameters parameters = weightless(D);
    parameters.surface_tension_threshold = 0.0;
    SumBench bench(make_particles(D, {{0.0, 0.0, 0.0}, {0.01, 0.0, 0.0}}), parameters);
    bench.set_state(1000.0, 0.0);
    bench.particles.rho[slot_of(bench.particles, 1)] = 500.0;
    bench.compute_acceleration(kTension);
    const Poly6<D> poly6(parameters.support_radius);
    const double V0 = parameters.particle_mass / 1000.0, V1 = parameters.particle_mass / 500.0;
    // j = i is part of the Laplacian of the colour field, and of its gradient with weight 0
    const double laplacian_c = V0 * poly6.laplacian(0.0) + V1 * poly6.laplacian(1e-4);
    // n points to the neighbour, +x for particle 0
    CHECK(bench.acceleration(0)[0] == Approx(-parameters.surface_tension * laplacian_c / 1000.0).epsilon(1e-12));
    CHECK(bench.acceleration(0)[1] == 0.0);
}

TEST_CASE("SurfaceTension.PullsACornerIntoTheLiquid") {
    SumBench bench(make_particles(3, lattice({8, 8, 8}, kThesisSpacing)), weightless(3));
    bench.set_state(998.29, 0.0);
    bench.compute_acceleration(kTension);
    const Vec3 corner = bench.acceleration(0);
    for (int k = 0; k < 3; ++k) CHECK(corner[k] > 0.0);
}
