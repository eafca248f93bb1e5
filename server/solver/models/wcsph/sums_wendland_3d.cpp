#include "server/solver/models/wcsph/sums_makers.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/solver/models/wcsph/sums_wendland_3d.cpp"
#include "hwy/foreach_target.h"
// After it, since it is compiled for each target.
#include "server/solver/models/wcsph/sums_of-inl.h"

HWY_BEFORE_NAMESPACE();
namespace headrace::solver::HWY_NAMESPACE {

WcsphSums* make_wendland_3d(const SumsChoice& choice, const PairNeighbours& neighbours) {
    return make_sums_of<3>(WendlandC2<3>(choice.support), neighbours, choice.support);
}

}  // namespace headrace::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace headrace::solver {

HWY_EXPORT(make_wendland_3d);
std::unique_ptr<WcsphSums> make_wendland_3d_sums(const SumsChoice& choice, const PairNeighbours& neighbours) {
    return std::unique_ptr<WcsphSums>(HWY_DYNAMIC_DISPATCH(make_wendland_3d)(choice, neighbours));
}

}  // namespace headrace::solver
#endif
