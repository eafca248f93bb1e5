#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Hydrostatic.PressureIsThatOfTheDepth") {
    // Half the target's resolution, first order next to the surface: twice its 0.5 %; energy as its square.
    check_case("hydrostatic", {.resolution = 25}, {{"rms_pressure", 0.01}, {"kinetic_energy", 4e-5}});
}

TEST_CASE("Hydrostatic.HoldsIn3D") {
    check_case("hydrostatic_3d", {.resolution = 10}, {{"rms_pressure", 0.025}, {"kinetic_energy", 2.5e-4}});
}

TEST_CASE("Hydrostatic.HoldsInASphere") {
    check_case("hydrostatic_sphere", {.resolution = 8}, {{"rms_pressure", 0.1}, {"kinetic_energy", 1e-3}});
}
