#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Balance.PairForcesKeepMomentum") {
    Settings settings;
    settings.parameters = {{"shifting", false}, {"tension_control", false}};
    check_case("balance", settings,
               {{"momentum", 1e-12}, {"angular_momentum", 1e-3}, {"energy_gain", 1e-3}, {"energy_balance", 0.02}});
}

TEST_CASE("Balance.ShiftingCostsLittleMomentum") {
    check_case("balance", {},
               {{"momentum", 5e-3}, {"angular_momentum", 0.02}, {"energy_gain", 1e-3}, {"energy_balance", 0.02}});
}
