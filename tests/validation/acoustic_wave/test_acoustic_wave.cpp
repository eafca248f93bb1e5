#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("AcousticWave.TravelsAtTheSoundSpeedAndDoesNotGrow") {
    check_case("acoustic_wave", {.resolution = 32}, {{"phase_speed", 0.02}, {"growth", 1e-6}});
}
