#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("Balance.MomentumIsKept") {
    check_case("balance", {}, {{"momentum", 1e-10}, {"energy_gain", 1e-3}});
}
