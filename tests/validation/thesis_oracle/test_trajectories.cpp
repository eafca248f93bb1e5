// The fast thesis model against its oracle, particle by particle, until chaos takes over. See README.md.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

#include "tests/support/oracle/paired_run.h"

using namespace headrace;
using oracle::Setup;

namespace {

constexpr int kSteps = 15;

// Both sum the same terms in another order: a step brings differences of some 1e-16 relative, which the motion enlarges
// by about 1.6 a step (1e-7 spacings become 0.12 in 30 steps), 1e3 in 15. A spacing is 1/50 of the scene, so positions
// differ by some 1e-14 spacings a step; with the enlargement 1e-11. Two decades are left for the hardest impact, where
// the largest density is six times the rest density. Any wrong term, factor or contact shows at 1e-4 or more.
constexpr double kTolerance = 1e-9;

void check_trajectories(Setup setup, const solver::ParameterMap& overrides = {}) {
    setup.overrides = overrides;
    setup.overrides["separate_coincident"] = false;
    oracle::FastRun fast(setup);
    oracle::ThesisOracle plain = oracle::make_oracle(setup, fast.model().parameters());
    REQUIRE(fast.particles().size() == plain.particles().size());

    oracle::Deviation deviation;
    for (int step = 0; step <= kSteps; ++step) {
        if (step > 0) {
            fast.step();
            plain.step();
        }
        CAPTURE(step);
        deviation = oracle::compute_deviation(fast.particles(), plain, setup.spacing);
        CHECK(deviation.x <= kTolerance);
        CHECK(deviation.v <= kTolerance);
        CHECK(deviation.v_half <= kTolerance);
        CHECK(deviation.a <= kTolerance);
        CHECK(deviation.rho <= kTolerance);
        CHECK(deviation.p <= kTolerance);
    }
    if (std::getenv("HEADRACE_PRINT_DEVIATION"))
        std::cout << "after " << kSteps << " steps: x " << deviation.x << " v " << deviation.v << " a " << deviation.a
                  << " rho " << deviation.rho << '\n';
}

}  // namespace

TEST_CASE("ThesisModel.SmallDamBreakFollowsTheOracle") {
    check_trajectories(oracle::small_dam_break());
}

TEST_CASE("ThesisModel.BowlFollowsTheOracle") {
    check_trajectories(oracle::bowl());
}

TEST_CASE("ThesisModel.FlatDamBreakFollowsTheOracle") {
    check_trajectories(oracle::flat_dam_break());
}

TEST_CASE("ThesisModel.ObstaclesFollowTheOracle") {
    const Setup setup = oracle::obstacle_dam_break();
    check_trajectories(setup);

    // Every obstacle is met: without it the motion is another.
    const solver::ParameterMap parameters = oracle::FastRun(setup).model().parameters();
    oracle::ThesisOracle with_all = oracle::make_oracle(setup, parameters);
    for (int step = 0; step < kSteps; ++step) with_all.step();
    for (std::size_t left_out = 1; left_out < setup.objects.size(); ++left_out) {
        Setup fewer = setup;
        fewer.objects.erase(fewer.objects.begin() + static_cast<std::ptrdiff_t>(left_out));
        oracle::ThesisOracle without = oracle::make_oracle(fewer, parameters);
        for (int step = 0; step < kSteps; ++step) without.step();
        double difference = 0.0;
        for (std::size_t i = 0; i < without.particles().size(); ++i)
            difference = std::max(difference, std::abs(without.particles()[i].x[0] - with_all.particles()[i].x[0]));
        CAPTURE(left_out);
        CHECK(difference > setup.spacing);
    }
}

TEST_CASE("ThesisModel.SymmetricPressureFollowsTheOracle") {
    check_trajectories(oracle::small_dam_break(), {{"pressure_form", std::string("symmetric")}});
    check_trajectories(oracle::flat_dam_break(), {{"pressure_form", std::string("symmetric")}});
}

TEST_CASE("ThesisModel.RestitutionAndStrongTensionFollowTheOracle") {
    // Terms that are zero or small with the thesis's values.
    check_trajectories(oracle::small_dam_break(), {{"restitution", 0.5}, {"surface_tension", 5.0}});
}
