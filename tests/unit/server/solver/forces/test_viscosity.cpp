#include <catch2/catch.hpp>

#include "../fixtures.h"
#include "server/solver/kernels.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

constexpr ForceTerms kViscous{PressureForm::mean, true, false};

template <int D>
SumBench make_sliding_pair() {
    SumBench bench(make_particles(D, {{0.0, 0.0, 0.0}, {0.01, 0.0, 0.0}}), weightless(D));
    bench.set_state(1000.0, 0.0);
    bench.particles.v[1][slot_of(bench.particles, 0)] = 0.5;
    bench.particles.v[0][slot_of(bench.particles, 1)] = -0.25;
    bench.particles.rho[slot_of(bench.particles, 1)] = 800.0;
    return bench;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Viscosity.PairHasTheValueByHand", "", ((int D), D), 2, 3) {
    SumBench bench = make_sliding_pair<D>();
    bench.compute_acceleration(kViscous);
    const double lap = ViscosityKernel<D>(bench.parameters.support_radius).laplacian(0.01);
    const double factor = 3.5 * bench.parameters.particle_mass / 800.0 * lap / 1000.0;
    CHECK(bench.acceleration(0)[0] == Approx(factor * -0.25).epsilon(1e-12));
    CHECK(bench.acceleration(0)[1] == Approx(factor * -0.5).epsilon(1e-12));
}

TEST_CASE("Viscosity.IsAntisymmetricAndSlowsRelativeMotion") {
    SumBench bench = make_sliding_pair<3>();
    bench.compute_acceleration(kViscous);
    for (int k = 0; k < 2; ++k) {
        CHECK(bench.acceleration(1)[k] == Approx(-bench.acceleration(0)[k]).epsilon(1e-13));
    }
    CHECK(bench.acceleration(0)[1] < 0.0);  // particle 0 moves along +y
}

TEST_CASE("Viscosity.LeavesRigidMotionAlone") {
    SumBench bench(make_particles(3, lattice({4, 4, 4}, kThesisSpacing)), weightless(3));
    bench.set_state(1000.0, 0.0);
    bench.particles.v[0].assign(64, 3.0);
    bench.compute_acceleration(kViscous);
    for (const double a : bench.particles.a[0]) CHECK(a == 0.0);
}
