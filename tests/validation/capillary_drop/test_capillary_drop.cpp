#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Laplace.PressureJumpIsSigmaOverR") {
    // At 14 spacings a radius, cut short; the target, 3 %, is for 20. Measured 0.023; 0.097 with particle shifting in
    // sight of the surface.
    check_case("laplace", {.resolution = 14, .brief = true}, {{"pressure_jump", 0.05}});
}

TEST_CASE("CapillaryDrop.SwingsWithLambsPeriod") {
    check_case("capillary_drop", {.resolution = 14, .brief = true}, {{"period", 0.05}});
}
