#include <catch2/catch.hpp>

#include "server/solver/boundaries/wall_state.h"

using namespace headrace::solver;

namespace {

// The pair of fluid at height y_i above a floor at 0 that moves with u, and a dummy `depth` below it.
std::array<double, 2> difference(double y_i, double depth, double v_i, double u, double least = 1e-3) {
    const Pair<2, double> pair{{0.4, y_i + depth}, 0.16 + (y_i + depth) * (y_i + depth), 0.0, 1.0};
    return no_slip_difference<2, double>(pair, {0.0, 1.0}, depth, {v_i, 0.0}, {u, 0.0}, least);
}

}  // namespace

TEST_CASE("NoSlip.IsExactForALinearProfile") {
    // v = u + s y: the dummy stands for v at its place, y = -depth.
    const double s = 3.0, u = 0.7;
    for (const double y : {0.1, 0.5, 1.3}) {
        for (const double depth : {0.05, 0.6, 1.4})
            CHECK(difference(y, depth, u + s * y, u)[0] == Approx(s * (y + depth)).epsilon(1e-14));
    }
    CHECK(difference(0.5, 0.2, 0.7, 0.7)[0] == 0.0);  // at rest beside the wall
}

TEST_CASE("NoSlip.FluidAtTheSurfaceStaysFinite") {
    // Closer than the least distance counts as being there.
    CHECK(difference(1e-9, 0.5, 1.0, 0.0, 0.25)[0] == Approx(1.0 + 0.5 / 0.25));
    CHECK(difference(-0.1, 0.5, 1.0, 0.0, 0.25)[0] == Approx(1.0 + 0.5 / 0.25));
}
