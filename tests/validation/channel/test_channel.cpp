#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Channel.StartsUpAsCouette") {
    check_case("couette", {.resolution = 50, .brief = true}, {{"l2_velocity", 5e-3}});
}

TEST_CASE("Channel.StartsUpAsPoiseuille") {
    check_case("poiseuille", {.resolution = 50, .brief = true}, {{"l2_velocity", 5e-3}});
}
