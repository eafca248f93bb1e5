#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("DamBreakPressure.FollowsTheConvergedSimulation") {
    check_case("dam_break_pressure", {.resolution = 28},
               {{"nrmse_wide", 0.32},
                {"arrival", 0.05},
                {"plateau_P1", 0.1},
                {"plateau_P2", 0.1},
                {"plateau_P3", 0.1},
                {"plateau_P4", 0.1}});
}
