#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Cavity.CentrelinesAtReynolds100") {
    // Half the target's resolution and second order at best: four times its 0.01.
    check_case("cavity_re100", {.resolution = 25}, {{"l2_u", 0.04}, {"l2_v", 0.04}});
}
