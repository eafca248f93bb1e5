#include <catch2/catch.hpp>

#include "../fixtures.h"
#include "server/solver/forces/separation.h"
#include "server/solver/kernels.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

TEMPLATE_TEST_CASE_SIG("Separation.DirectionIsAntisymmetricUnitAndChanging", "", ((int D), D), 2, 3) {
    for (std::uint64_t step = 0; step < 100; ++step) {
        const auto e = separation_direction<D>(4, 9, step), minus = separation_direction<D>(9, 4, step);
        double length2 = 0.0;
        for (int k = 0; k < D; ++k) {
            CHECK(e[k] == -minus[k]);
            CHECK(e[k] != 0.0);
            length2 += e[k] * e[k];
        }
        CHECK(length2 == Approx(1.0).epsilon(1e-14));
        CHECK(e != separation_direction<D>(4, 9, step + 1));
        CHECK(e != separation_direction<D>(5, 9, step));
    }
}

TEST_CASE("Separation.CoincidentPairRepelsWithTheSlopeAtZero") {
    for (const double p : {200.0, -200.0}) {
        SumBench bench(make_particles(3, {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}), weightless(3));
        bench.set_state(800.0, p);
        bench.step = 3;
        bench.compute_acceleration({PressureForm::mean, false, false});
        const auto e = separation_direction<3>(0, 1, 3);
        const double size = 200.0 * 0.02 / 800.0 * -Spiky<3>(0.0457).slope(0.0) / 800.0;
        for (int k = 0; k < 3; ++k) {
            CHECK(bench.acceleration(0)[k] == Approx(size * e[k]).epsilon(1e-12));
            CHECK(bench.acceleration(1)[k] == -bench.acceleration(0)[k]);
        }
    }
}

TEST_CASE("Separation.SwitchedOffThePairStaysTogether") {
    ThesisParameters parameters = weightless(3);
    parameters.separate_coincident = false;
    SumBench bench(make_particles(3, {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}), parameters);
    bench.set_state(800.0, 200.0);
    bench.compute_acceleration({PressureForm::mean, true, false});
    CHECK(bench.acceleration(0) == Vec3{});
    CHECK(bench.acceleration(1) == Vec3{});
}
