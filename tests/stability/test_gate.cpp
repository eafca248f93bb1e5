// The brief part of the stability gate: scenes that try to break the model keep its criteria or stop themselves.
#include <omp.h>

#include <catch2/catch.hpp>
#include <string>

#include "tests/stability/cases/scenario.h"

using namespace headrace;

namespace {

// Small scenes: threads would cost more than they give.
void check_all(const std::string& prefix) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    std::size_t count = 0;
    for (const stability::Scenario& one : stability::scenarios()) {
        if (!one.is_brief || !one.name.starts_with(prefix)) continue;
        const auto outcome = stability::run_scenario(one);
        INFO(one.name << ", " << one.variant);
        REQUIRE(outcome.ok());
        INFO(describe(*outcome));
        CHECK(outcome->verdict != stability::Verdict::failed);
        ++count;
    }
    omp_set_num_threads(before);
    CHECK(count > 0);
}

}  // namespace

TEST_CASE("Stability.StepsWithinTheLimitsKeepTheCriteriaAndLongerOnesStop") {
    check_all("step_");
}
TEST_CASE("Stability.ImpactsOnEveryShapeNeitherLeakNorGainEnergy") {
    check_all("impact_");
}
TEST_CASE("Stability.DropsAndJetsNeitherLeakNorGainEnergy") {
    check_all("drop_");
    check_all("jet_");
}
TEST_CASE("Stability.ColumnsOfAFewSpacingsStand") {
    check_all("gap_");
}
TEST_CASE("Stability.ParametersMayChangeViolently") {
    check_all("change_");
}
TEST_CASE("Stability.WallsMayMoveComeAndGo") {
    check_all("jumping_piston");
    check_all("paddle");
    check_all("added_and_removed");
    check_all("container_changed");
}
TEST_CASE("Stability.BadStartsMend") {
    check_all("coincident");
    check_all("random_start");
}
TEST_CASE("Stability.FluidUnderTensionHolds") {
    check_all("stretching_patch");
    check_all("spinning_patch");
    check_all("tension_");
}
TEST_CASE("Stability.StillWaterStaysStill") {
    check_all("rest");
}
TEST_CASE("Stability.RandomScenesOfSomeSeedsRun") {
    check_all("random_");
}
