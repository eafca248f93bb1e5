// Measured and computed reference data that is not in the repository: tables of a folder named by the environment
// variable HEADRACE_REFERENCE_DIR, else by the build's option of the same name. Without it the cases that need it skip.
#pragma once

#include <string>
#include <vector>

namespace headrace::validation {

// Columns of numbers below one line of heads; empty cells are NaN. Empty: there is no such file.
using Table = std::vector<std::vector<double>>;  // [column][row]

Table load_reference(const std::string& relative_path);  // "lid_driven_cavity/u_centreline_computed_full.csv"

// Piecewise linear y(x); constant beyond the ends. x ascends.
double interpolate_linear(const std::vector<double>& x, const std::vector<double>& y, double at);

}  // namespace headrace::validation
