// `headrace_bench speed --compare`: two builds on the same cases in one run.
#pragma once

#include <string>
#include <vector>

namespace headrace::bench {

// Runs this program and `other` by turns, so often each, with the arguments (--compare, --rounds and --out are left
// out) and prints how much faster this one is, case by case: smallest, median and largest ratio of the turns. Returns
// the exit status.
int compare_builds(const std::string& other, int rounds, const std::vector<std::string>& arguments);

}  // namespace headrace::bench
