#include "tests/bench/speed_sums.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/speed_sums.cpp"
#include "hwy/foreach_target.h"
// After it, since it is compiled for each target.
#include "tests/bench/speed_sums-inl.h"

#if HWY_ONCE
namespace headrace::bench {

HWY_EXPORT(make_sums);

std::string_view pair_strategy_name(PairStrategy strategy) {
    switch (strategy) {
        case PairStrategy::clusters:
            return "clusters";
        case PairStrategy::half:
            return "half";
        case PairStrategy::buffer:
            return "buffer";
        case PairStrategy::broadcast:
            break;
    }
    return "broadcast";
}

std::unique_ptr<PlainSums> make_plain_sums(PairStrategy strategy, int dimensions) {
    return std::unique_ptr<PlainSums>(HWY_DYNAMIC_DISPATCH(make_sums)(strategy, dimensions));
}

}  // namespace headrace::bench
#endif
