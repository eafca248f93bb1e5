#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("DamBreakFront.FollowsMartinAndMoyce") {
    check_case("dam_break_front", {.resolution = 20}, {{"front_nrmse", 0.18}});
}
