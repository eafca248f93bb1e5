// How the OpenMP team waits between its parallel regions.
#pragma once

namespace headrace::solver {

// Starts the program anew, once, with a short spin of libgomp's waiting threads, unless the environment says how they
// shall wait (OMP_WAIT_POLICY, GOMP_SPINCOUNT). Call it first thing in main; libgomp reads the setting when it is
// loaded, so nothing later can change it. Returns when there is nothing to do, or when the restart is not possible.
//
// Why: by default the threads spin for milliseconds. On a machine that is busy otherwise each barrier then costs a time
// slice: a dam break of 3,000 particles on two threads took 18 ms a step instead of 0.4 ms. Sleeping at once (passive)
// takes 0.7 ms a step on the same scene when the machine is idle, the short spin 0.36 ms.
void restart_with_short_spin(char** argv);

}  // namespace headrace::solver
