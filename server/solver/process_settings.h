// Settings of the libraries below that are read when the program is loaded: how the OpenMP team waits, and what pages
// memory has.
#pragma once

namespace headrace::solver {

// Starts the program anew, once, with settings of ours in its environment, unless the environment has its own
// (OMP_WAIT_POLICY or GOMP_SPINCOUNT; GLIBC_TUNABLES). Call it first thing in main. Returns when there is nothing to
// do, or when the restart is not possible.
//
// A short spin of libgomp's waiting threads: by default they spin for milliseconds. On a machine that is busy otherwise
// each barrier then costs a time slice: a dam break of 3,000 particles on two threads took 18 ms a step instead of 0.4.
// Sleeping at once (passive) takes 0.7 ms on the same scene when the machine is idle, the short spin 0.36 ms.
//
// Huge pages for what is allocated: at 10^6 particles sorting takes half of the time (28 to 13 ns a particle).
//
// Arrays of 1 MiB and more have pages of their own, which go back to the system when they are freed. glibc would do so
// at first, and from the first one freed on put arrays up to 32 MB between the many small ones of the neighbour lists,
// where their room is lost: 7 bytes a particle at 10^6. Of the small ones, which come and go with each sort, up to 64
// MiB at the end are kept.
void restart_with_settings(char** argv);

}  // namespace headrace::solver
