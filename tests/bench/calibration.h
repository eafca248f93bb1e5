// What the machine gives at this moment, whatever the solver does with it.
#pragma once

namespace headrace::bench {

// [GFLOP/s] of one core in fused multiply-adds in registers, single precision, in the instruction set of now
// (OnlyInstructionSet).
double measure_fma_gflops();

}  // namespace headrace::bench
