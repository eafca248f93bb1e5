#include "tests/validation/check_case.h"

#include <omp.h>

#include <catch2/catch.hpp>
#include <iostream>

namespace headrace::validation {

void check_case(const std::string& name, const Settings& settings, const std::vector<Tolerance>& tolerances) {
    const Case* one = find_case(name);
    REQUIRE(one != nullptr);
    omp_set_num_threads(1);  // small cases, and ctest runs several at a time
    const auto outcome = run_case(*one, settings);
    INFO(name << ": " << (outcome ? outcome->fault : outcome.error().message + " " + outcome.error().path));
    REQUIRE(outcome.ok());
    REQUIRE(outcome->fault.empty());
    for (const Measured& measured : outcome->metrics)
        std::cout << name << " " << measured.metric << " = " << measured.value << '\n';
    std::cout << name << ": " << outcome->particles << " particles, " << outcome->steps << " steps, " << outcome->wall
              << " s\n";
    CHECK(outcome->value("leaked") == 0.0);
    if (outcome->metrics.size() == 1) {  // only "leaked": there was nothing to compare with
        std::cout << "skipped: reference data are absent\n";
        return;
    }
    for (const Tolerance& tolerance : tolerances) {
        INFO(tolerance.metric);
        CHECK(outcome->value(tolerance.metric) <= tolerance.largest);
    }
}

}  // namespace headrace::validation
