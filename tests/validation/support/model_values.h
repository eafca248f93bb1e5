// Values of a model that the metrics need, read from its parameters.
#pragma once

#include <string>

#include "server/scene/run.h"

namespace headrace::validation {

// The number of this name, or `otherwise` where the model has none.
double find_number(const scene::Run& run, const std::string& name, double otherwise);

// [m/s] sound speed at rest density; thesis: sqrt(k) of p = k (rho - rho0). 0: unknown.
double find_sound_speed(const scene::Run& run);

// Is the state equation Tait's, p = rho0 c0^2 / 7 ((rho/rho0)^7 - 1), rather than linear?
bool has_tait(const scene::Run& run);

}  // namespace headrace::validation
