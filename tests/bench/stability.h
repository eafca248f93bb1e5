// headrace_bench stability: the scenes that try to break the model, judged by written criteria.
#pragma once

namespace headrace::bench {

// argv[0] is "stability". Returns the exit status: 1 where a scene failed.
int run_stability(int argc, char** argv);

}  // namespace headrace::bench
