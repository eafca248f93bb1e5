// Instruction sets the pair loops are compiled for. One binary holds them all and takes the best the processor has.
//
// A loop is written once as an always-inlined template and instantiated in one thin function per set. (Not
// `target_clones`: it does not reach into templates and OpenMP regions, and its resolvers run before the sanitizers'.)
// Sums differ in rounding between sets, never between runs on one.
#pragma once

#include <string_view>

namespace headrace::solver {

enum class Isa { baseline, avx2, avx512 };

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define HEADRACE_TARGET_AVX2 [[gnu::target("avx2,fma")]]
#define HEADRACE_TARGET_AVX512 [[gnu::target("avx512f,avx512dq,avx512vl,avx512bw,avx2,fma,prefer-vector-width=512")]]
#else
#define HEADRACE_TARGET_AVX2
#define HEADRACE_TARGET_AVX512
#endif

// The best set of this processor.
Isa best_isa();

std::string_view isa_name(Isa isa);

}  // namespace headrace::solver
