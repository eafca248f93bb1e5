#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("TaylorGreen.DecaysAtReynolds100FromALattice") {
    check_case("taylor_green_re100", {.resolution = 100}, {{"l2_velocity", 5e-3}});
}

TEST_CASE("TaylorGreen.DecaysAtReynolds100FromAPerturbedStart") {
    check_case("taylor_green_re100_perturbed", {.resolution = 100}, {{"l2_velocity", 5e-3}});
}

TEST_CASE("TaylorGreen.DecaysAtReynolds1000") {
    check_case("taylor_green_re1000", {.resolution = 50}, {{"l2_velocity", 0.02}});
}
