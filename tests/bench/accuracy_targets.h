// The cases at the resolution of their targets, against them.
#pragma once

#include <string>
#include <vector>

#include "tests/validation/support/case.h"

namespace headrace::bench {

// Runs and prints a row per metric: value, what it must and aims to be, verdict, wall time. Cases that take many
// minutes only when `names` has them. In the table (Markdown) at `path` a case's rows take the place of those it had.
// False: a `must` was missed, or the table cannot be written.
bool run_targets(const std::vector<std::string>& names, const validation::Settings& settings, const std::string& path);

}  // namespace headrace::bench
