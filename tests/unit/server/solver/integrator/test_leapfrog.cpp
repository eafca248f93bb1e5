#include <catch2/catch.hpp>
#include <cmath>

#include "server/solver/integrator/leapfrog.h"

using namespace headrace::solver;

namespace {

struct Error {
    double x, v;
};

// x'' = -x from (1, 0) to t = 1 with n steps; every second step is `ratio` times the other.
Error oscillate(int n, double ratio = 1.0) {
    const double unit = 1.0 / (n / 2 * (1.0 + ratio));
    double x = 1.0, dt_before = unit, v_half = leap_start(0.0, -1.0, unit), v = 0.0, t = 0.0;
    for (int i = 0; i < n; ++i) {
        const double dt = i % 2 == 0 ? unit : ratio * unit;
        const double before = v_half;
        v_half = leap_velocity(v_half, -x, dt_before, dt);
        v = mean_velocity(before, v_half);
        if (i == n - 1) return {0.0, std::abs(v + std::sin(t))};
        x = leap_position(x, v_half, dt);
        t += dt;
        dt_before = dt;
    }
    return {};
}

double position_error(int n, double ratio = 1.0) {
    const double unit = 1.0 / (n / 2 * (1.0 + ratio));
    double x = 1.0, dt_before = unit, v_half = leap_start(0.0, -1.0, unit);
    for (int i = 0; i < n; ++i) {
        const double dt = i % 2 == 0 ? unit : ratio * unit;
        v_half = leap_velocity(v_half, -x, dt_before, dt);
        x = leap_position(x, v_half, dt);
        dt_before = dt;
    }
    return std::abs(x - std::cos(1.0));
}

}  // namespace

TEST_CASE("LeapFrog.StartsHalfAStepBehind") {
    CHECK(leap_start(3.0, 10.0, 0.2) == 2.0);
}

TEST_CASE("LeapFrog.ConstantAccelerationIsExact") {
    // v_half = g (t - dt/2), so x = g t^2 / 2 at every step
    double x = 0.0, v_half = leap_start(0.0, 2.0, 0.25);
    for (int i = 1; i <= 8; ++i) {
        v_half = leap_velocity(v_half, 2.0, 0.25, 0.25);
        x = leap_position(x, v_half, 0.25);
        CHECK(x == (0.25 * i) * (0.25 * i));
    }
}

TEST_CASE("LeapFrog.IsOfSecondOrder") {
    // halving dt quarters the error; 0.1: terms of higher order at n = 100
    CHECK(position_error(100) / position_error(200) == Approx(4.0).margin(0.1));
    CHECK(oscillate(100).v / oscillate(200).v == Approx(4.0).margin(0.15));
}

TEST_CASE("LeapFrog.KeepsItsOrderWhenTheStepChanges") {
    // With 2.33 unchanged (the new step alone) the error would fall by 2.
    CHECK(position_error(100, 0.5) / position_error(200, 0.5) > 3.5);
}
