// headrace_bench accuracy: run time against error on the validation cases.
#pragma once

namespace headrace::bench {

// argv[0] is "accuracy". Returns the exit status.
int run_accuracy(int argc, char** argv);

}  // namespace headrace::bench
