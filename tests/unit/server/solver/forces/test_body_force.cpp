#include <catch2/catch.hpp>

#include "../fixtures.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

TEST_CASE("BodyForce.LoneParticleFallsWithG") {
    SumBench bench(make_particles(3, {{0, 0, 0}}), make_thesis_parameters(3, kThesisSpacing, {}));
    bench.compute_density();
    bench.particles.p[0] = 77.0;
    bench.compute_acceleration({PressureForm::mean, true, false});
    CHECK(bench.acceleration(0) == Vec3{0.0, -9.82, 0.0});
}
