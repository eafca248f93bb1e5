// One particle explained: its neighbours, and the acceleration of each term on it in the present state.
//
// The step evaluates slow forces once, at its start, and shifts the particles after its last pressure force; here all
// terms are those of the state as it is, so `a` may differ a little from the acceleration the step left.
#pragma once

#include <optional>

#include "server/solver/model.h"
#include "server/solver/models/wcsph/pair_terms.h"
#include "server/solver/models/wcsph/sums.h"

namespace headrace::solver {

struct InspectionInput {
    const WcsphView& view;
    const WcsphSums& sums;
    const TermOptions& options;
    const Surroundings& surroundings;
    const std::vector<std::string>& wall_names;  // of the walls' objects
    double support{};                            // [m]
    Vec3 gravity{};                              // [m/s^2]
    const Visibility* thin_walls{};              // null unless pairs may be separated by a thin panel
};

// Looks at all particles, whatever their order; nothing where no particle has this id.
std::optional<ParticleInspection> inspect_particle(const InspectionInput& in, Index id);

}  // namespace headrace::solver
