#include "server/solver/integrator/step_limits.h"

#include <cmath>
#include <limits>

#include "server/solver/kernels.h"

namespace headrace::solver {
namespace {

template <int D>
double viscous_limit(const LimitInput& input) {
    if (input.viscosity <= 0.0) return std::numeric_limits<double>::infinity();
    const double rho_pair = 2.0 * input.particle_mass * Poly6<D>(input.support).W(0.0);
    const double lambda = 2.0 * input.viscosity * input.particle_mass *
                          ViscosityKernel<D>(input.support).laplacian(0.0) / (rho_pair * rho_pair);
    return 2.0 / lambda;
}

}  // namespace

StepLimit find_step_limit(const LimitInput& input) {
    const double acoustic = 0.4 * input.support / (std::sqrt(input.stiffness) + input.max_speed);
    const double viscous = input.dimensions == 3 ? viscous_limit<3>(input) : viscous_limit<2>(input);
    return viscous < acoustic ? StepLimit{viscous, "viscous"} : StepLimit{acoustic, "acoustic"};
}

}  // namespace headrace::solver
