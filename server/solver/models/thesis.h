// The thesis model: D. Staubach, "Smoothed Particle Hydrodynamics - Real-Time Fluid Simulation Approach", bachelor
// thesis, FAU Erlangen-Nürnberg, 2010, to the letter. Soft (c = sqrt(k) = 1.7 m/s), real-time, not volume conserving:
// the yardstick other models must beat. Departures are named where they are made: the accelerations are gathered, not
// mutual (thesis_sums.h), coincident particles part (separation.h), box obstacles exist (box.h), containers win
// (collider.h).
#pragma once

#include <memory>

#include "server/solver/model.h"

namespace headrace::solver {

std::unique_ptr<Model> make_thesis(int dimensions, double spacing, const ParameterMap& overrides);

}  // namespace headrace::solver
