#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("StandingWave.HasTheLinearPeriod") {
    check_case("standing_wave", {.resolution = 25, .brief = true}, {{"period", 0.01}, {"damping", 2e-3}});
}

TEST_CASE("StandingWave.DecaysAsTheViscousEigenmode") {
    check_case("standing_wave_viscous", {.resolution = 25, .brief = true}, {{"decay_rate", 0.1}, {"period", 0.01}});
}
