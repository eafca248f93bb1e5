#include <catch2/catch.hpp>

#include "tests/validation/check_case.h"

using namespace headrace::validation;

TEST_CASE("FreeFall.IsBallistic") {
    check_case("free_fall", {}, {{"way", 1e-10}, {"energy", 1e-10}, {"pressure", 1e-10}, {"width", 1e-10}});
}
