// A case as a test: one brief run, its metrics against tolerances, no particle lost.
#pragma once

#include <string>
#include <vector>

#include "tests/validation/support/case.h"

namespace headrace::validation {

struct Tolerance {
    std::string metric;
    double largest{};
};

// Runs the case and checks (Catch2) that it ends, loses no particle and stays within the tolerances. A case whose
// reference data is absent says so in the words by which ctest counts it as skipped.
void check_case(const std::string& name, const Settings& settings, const std::vector<Tolerance>& tolerances);

}  // namespace headrace::validation
