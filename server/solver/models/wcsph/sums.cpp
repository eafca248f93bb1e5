#include "server/solver/models/wcsph/sums.h"

#include "server/solver/models/wcsph/sums_makers.h"

namespace headrace::solver {

std::unique_ptr<WcsphSums> make_wcsph_sums(const SumsChoice& choice, const PairNeighbours& neighbours) {
    if (choice.kernel == KernelKind::wendland_c2)
        return choice.dimensions == 2 ? make_wendland_2d_sums(choice, neighbours)
                                      : make_wendland_3d_sums(choice, neighbours);
    return choice.dimensions == 2 ? make_any_kernel_2d_sums(choice, neighbours)
                                  : make_any_kernel_3d_sums(choice, neighbours);
}

}  // namespace headrace::solver
