#include "server/solver/models/wcsph/sums_makers.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/solver/models/wcsph/sums_any_kernel_2d.cpp"
#include "hwy/foreach_target.h"
// After it, since it is compiled for each target.
#include "server/solver/models/wcsph/sums_of-inl.h"

HWY_BEFORE_NAMESPACE();
namespace headrace::solver::HWY_NAMESPACE {

WcsphSums* make_any_kernel_2d(const SumsChoice& choice, const PairNeighbours& neighbours) {
    return make_sums_of<2>(AnyKernel<2>(choice.kernel, choice.support), neighbours, choice.support);
}

}  // namespace headrace::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace headrace::solver {

HWY_EXPORT(make_any_kernel_2d);
std::unique_ptr<WcsphSums> make_any_kernel_2d_sums(const SumsChoice& choice, const PairNeighbours& neighbours) {
    return std::unique_ptr<WcsphSums>(HWY_DYNAMIC_DISPATCH(make_any_kernel_2d)(choice, neighbours));
}

}  // namespace headrace::solver
#endif
