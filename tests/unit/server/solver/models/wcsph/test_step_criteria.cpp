#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "server/solver/models/wcsph/step_criteria.h"

using namespace headrace::solver;

namespace {

StepCriteria usual() {
    StepCriteria c;
    c.h = 0.01;
    c.sound_speed = 20.0;
    c.cfl = 0.6;
    c.advective_cfl = 0.25;
    c.most_acoustic_steps = 1000;
    return c;
}

void check(const StepCriteria& criteria, double dt, const std::string& name) {
    const StepChoice choice = choose_step(criteria);
    CHECK(choice.dt == Approx(dt));
    CHECK(std::string(choice.criterion) == name);
    // Acoustic parts no longer than their own criterion, and no more of them than needed.
    const double acoustic = criteria.cfl * criteria.h / (criteria.sound_speed + criteria.max_speed);
    CHECK(choice.dt / choice.acoustic_steps <= acoustic * (1.0 + 1e-12));
    CHECK(choice.dt / (choice.acoustic_steps - 0.999999) > acoustic);
}

}  // namespace

TEST_CASE("StepCriteria.EachIsNamedWhereItLimits") {
    StepCriteria c = usual();
    c.max_speed = 2.0;
    check(c, 0.25 * 0.01 / 2.0, "advective");
    c.orders_confined_flow = true;
    check(c, 0.15 * 0.01 / 2.0, "advective");
    c = usual();
    c.kinematic_viscosity = 0.5;
    check(c, 0.125 * 0.01 * 0.01 / 0.5, "viscous");
    c = usual();
    c.max_acceleration = 400.0;
    check(c, 0.25 * std::sqrt(0.01 / 400.0), "body force");
    c = usual();
    c.tension_over_density = 0.1;
    check(c, 0.25 * std::sqrt(1e-6 / (2.0 * std::numbers::pi * 0.1)), "surface tension");
}

TEST_CASE("StepCriteria.AcousticLimitsWhereNothingElseOrTooManyParts") {
    StepCriteria c = usual();
    c.most_acoustic_steps = 5;
    check(c, 5.0 * 0.6 * 0.01 / 20.0, "acoustic");
    c.max_speed = 1e-3;
    check(c, 5.0 * 0.6 * 0.01 / 20.001, "acoustic");
    // One time step for all: the shorter of both.
    c.most_acoustic_steps = 1;
    c.max_speed = 2.0;
    CHECK(choose_step(c).dt == Approx(0.6 * 0.01 / 22.0));
    CHECK(choose_step(c).acoustic_steps == 1);
    c.max_acceleration = 1e6;
    CHECK(choose_step(c).criterion == "body force");
    CHECK(choose_step(c).acoustic_steps == 1);
}
