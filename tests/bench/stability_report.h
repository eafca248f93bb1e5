// The outcomes of the stability gate as a table and a heat map.
#pragma once

#include <string>
#include <vector>

#include "tests/stability/cases/scenario.h"

namespace headrace::bench {

// One line per outcome: case, variant, verdict, sizes, each criterion over its bound, fault.
std::string stability_csv(const std::vector<stability::Outcome>& outcomes);

// Counts of verdicts, the hardest criterion of what did not pass.
std::string stability_summary(const std::vector<stability::Outcome>& outcomes);

// A PNG: a row per case, a cell per variant. Returns false when gnuplot could not.
bool draw_stability(const std::vector<stability::Outcome>& outcomes, const std::string& file);

}  // namespace headrace::bench
