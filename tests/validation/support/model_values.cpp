#include "tests/validation/support/model_values.h"

#include <cmath>

namespace headrace::validation {

namespace {
constexpr double kLeastCompression = 1e-9;  // below it round-off of rho is felt in the quotient
}  // namespace

double find_number(const scene::Run& run, const std::string& name, double otherwise) {
    const solver::ParameterMap parameters = run.model().parameters();
    const auto found = parameters.find(name);
    const double* value = found == parameters.end() ? nullptr : std::get_if<double>(&found->second);
    return value ? *value : otherwise;
}

double find_sound_speed(const scene::Run& run) {
    if (run.model().name() == "thesis") return std::sqrt(find_number(run, "stiffness", 0.0));
    if (const double given = find_number(run, "sound_speed", 0.0); given > 0.0) return given;
    // By the model's rule: the particle under the most pressure tells which.
    const solver::Particles& particles = run.particles();
    const double rho0 = run.model().rest_density();
    double most = kLeastCompression, square = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double ratio = particles.rho[i] / rho0;
        if (std::abs(ratio - 1) <= most) continue;
        most = std::abs(ratio - 1);
        square = has_tait(run) ? 7 * particles.p[i] / (rho0 * (std::pow(ratio, 7) - 1))
                               : particles.p[i] / (rho0 * (ratio - 1));
    }
    return std::sqrt(square);
}

bool has_tait(const scene::Run& run) {
    const solver::ParameterMap parameters = run.model().parameters();
    const auto found = parameters.find("state_equation");
    const std::string* value = found == parameters.end() ? nullptr : std::get_if<std::string>(&found->second);
    return value && *value == "tait";
}

}  // namespace headrace::validation
