// `headrace_bench speed --compare`: two builds on the same cases in one run.
#pragma once

#include <string>
#include <vector>

namespace headrace::bench {

// Runs this program and `other` by turns with the arguments (--compare and --out are replaced) and prints how much
// faster this one is, case by case. Returns the exit status.
int compare_builds(const std::string& other, const std::vector<std::string>& arguments);

}  // namespace headrace::bench
