// headrace_bench strategies: run time of a step over particles and threads, strategy by strategy (strategy_sums.h).
#pragma once

namespace headrace::bench {

// argv[0] is "strategies". Returns the exit status.
int run_strategies(int argc, char** argv);

}  // namespace headrace::bench
