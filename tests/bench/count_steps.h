// headrace_bench count-steps: steps a scene in a place of its own, for those who count its instructions
// (plan_costs.py).
#pragma once

namespace headrace::bench {

// argv[0] is "count-steps". Returns the exit status.
int run_count_steps(int argc, char** argv);

}  // namespace headrace::bench
