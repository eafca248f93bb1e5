#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("OscillatingDrop.FollowsTheExactSemiAxisForAPeriod") {
    check_case("oscillating_drop", {.resolution = 20, .brief = true},
               {{"rms_a", 2e-3}, {"energy_loss_one_period", 0.015}});
}
