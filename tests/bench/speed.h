// headrace_bench speed: particle-steps per second and core, stage by stage, of the pair engine and of whole models.
#pragma once

namespace headrace::bench {

// argv[0] is "speed". Returns the exit status.
int run_speed(int argc, char** argv);

}  // namespace headrace::bench
