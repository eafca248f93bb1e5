#include "server/solver/isa.h"

namespace headrace::solver {

Isa best_isa() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw")) {
        return Isa::avx512;
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Isa::avx2;
#endif
    return Isa::baseline;
}

std::string_view isa_name(Isa isa) {
    switch (isa) {
        case Isa::avx512:
            return "AVX-512";
        case Isa::avx2:
            return "AVX2";
        case Isa::baseline:
            break;
    }
    return "baseline";
}

}  // namespace headrace::solver
