#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("EllipticalDrop.HasTheExactSemiAxes") {
    check_case("elliptical_drop", {.resolution = 40}, {{"semi_axis_a", 0.01}, {"semi_axis_b", 0.01}});
}
