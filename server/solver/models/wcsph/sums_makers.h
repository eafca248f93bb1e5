// The makers behind make_wcsph_sums, a file each: the default kernel, and any.
#pragma once

#include "server/solver/models/wcsph/sums.h"

namespace headrace::solver {

std::unique_ptr<WcsphSums> make_wendland_2d_sums(const SumsChoice& choice, const PairNeighbours& neighbours);
std::unique_ptr<WcsphSums> make_wendland_3d_sums(const SumsChoice& choice, const PairNeighbours& neighbours);
std::unique_ptr<WcsphSums> make_any_kernel_2d_sums(const SumsChoice& choice, const PairNeighbours& neighbours);
std::unique_ptr<WcsphSums> make_any_kernel_3d_sums(const SumsChoice& choice, const PairNeighbours& neighbours);

}  // namespace headrace::solver
