#include "server/solver/models/wcsph/sums_of.h"

namespace headrace::solver {

std::unique_ptr<WcsphSums> make_any_kernel_sums(int dimensions, KernelKind kernel, double support, Isa isa) {
    if (dimensions == 2) return std::make_unique<SumsOf<2, AnyKernel<2>>>(AnyKernel<2>(kernel, support), isa);
    return std::make_unique<SumsOf<3, AnyKernel<3>>>(AnyKernel<3>(kernel, support), isa);
}

std::unique_ptr<WcsphSums> make_wcsph_sums(int dimensions, KernelKind kernel, double support, Isa isa) {
    return kernel == KernelKind::wendland_c2 ? make_wendland_sums(dimensions, support, isa)
                                             : make_any_kernel_sums(dimensions, kernel, support, isa);
}

}  // namespace headrace::solver
