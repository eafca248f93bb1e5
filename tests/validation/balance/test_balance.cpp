#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Balance.PairForcesKeepMomentum") {
    Settings settings;
    settings.parameters = {{"shifting", false}, {"tension_control", false}};
    // Sums of single precision: each force is off by 6e-8 of itself, at random.
    for (const auto& [precision, momentum] : {std::pair("double", 1e-12), std::pair("single", 6e-8)}) {
        settings.parameters["precision"] = std::string(precision);
        check_case(
            "balance", settings,
            {{"momentum", momentum}, {"angular_momentum", 1e-3}, {"energy_gain", 1e-3}, {"energy_balance", 0.02}});
    }
}

TEST_CASE("Balance.ShiftingCostsLittleMomentum") {
    check_case("balance", {},
               {{"momentum", 5e-3}, {"angular_momentum", 0.02}, {"energy_gain", 1e-3}, {"energy_balance", 0.02}});
}
