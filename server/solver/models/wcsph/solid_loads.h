// Forces on objects that are walls without particles, found on demand: action equals reaction, as in loads.h.
#pragma once

#include <vector>

#include "server/solver/model.h"
#include "server/solver/models/wcsph/pair_terms.h"

namespace headrace::solver {

// sums: of the pressure pass in the present state. Adds the fluid's force on each object.
void add_solid_loads(const WcsphView& view, const SolidSums& sums, const TermOptions& options,
                     std::vector<ObjectLoad>& loads);

}  // namespace headrace::solver
