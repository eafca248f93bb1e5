// What each numerical option of wcsph costs: processor time against the default's, measured by turns in one run.
#pragma once

#include <string>

namespace headrace::bench {

// A developed dam break and a confined flow. Writes costs.csv and costs.md below `folder` and prints the latter.
// False: a scene was refused or a run broke, said on stderr.
bool measure_costs(const std::string& folder);

}  // namespace headrace::bench
