#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Lobovsky.LevelsFollowTheExperiment") {
    check_case("lobovsky", {.resolution = 30},
               {{"level_H1", 0.03}, {"level_H2", 0.03}, {"level_H3", 0.03}, {"level_H4", 0.03}});
}
