#include "server/solver/models/wcsph/sums_of.h"

namespace headrace::solver {

std::unique_ptr<WcsphSums> make_wendland_sums(int dimensions, double support, Isa isa) {
    if (dimensions == 2) return std::make_unique<SumsOf<2, WendlandC2<2>>>(WendlandC2<2>(support), isa);
    return std::make_unique<SumsOf<3, WendlandC2<3>>>(WendlandC2<3>(support), isa);
}

}  // namespace headrace::solver
