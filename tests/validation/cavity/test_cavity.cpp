#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Cavity.CentrelinesAtReynolds100") {
    // Half the target's resolution and first order at worst: twice its tolerance. Measured 0.008, 0.010.
    check_case("cavity_re100", {.resolution = 25}, {{"l2_u", 0.02}, {"l2_v", 0.02}});
}

TEST_CASE("Cavity.WallsAsIntegralsDoAsWell") {
    // The tolerance of the particles. Its lid is the only thing that moves the fluid.
    Settings settings{.resolution = 25};
    settings.parameters["walls"] = std::string("integrals");
    check_case("cavity_re100", settings, {{"l2_u", 0.02}, {"l2_v", 0.02}});
}
