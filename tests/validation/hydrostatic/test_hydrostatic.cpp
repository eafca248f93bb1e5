#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Hydrostatic.PressureIsThatOfTheDepth") {
    check_case("hydrostatic", {.resolution = 25}, {{"rms_pressure", 5e-3}, {"kinetic_energy", 1e-5}});
}

TEST_CASE("Hydrostatic.HoldsIn3D") {
    check_case("hydrostatic_3d", {.resolution = 10}, {{"rms_pressure", 0.025}, {"kinetic_energy", 1e-5}});
}

TEST_CASE("Hydrostatic.HoldsInASphere") {
    check_case("hydrostatic_sphere", {.resolution = 8}, {{"rms_pressure", 0.025}, {"kinetic_energy", 5e-5}});
}
