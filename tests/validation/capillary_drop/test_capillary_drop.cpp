#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Laplace.PressureJumpIsSigmaOverR") {
    check_case("laplace", {.resolution = 14, .brief = true}, {{"pressure_jump", 0.05}});
}

TEST_CASE("CapillaryDrop.SwingsWithLambsPeriod") {
    check_case("capillary_drop", {.resolution = 14, .brief = true}, {{"period", 0.05}});
}
