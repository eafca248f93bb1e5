#include "server/solver/models/wcsph/sound_speed.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace headrace::solver {
namespace {

double largest_norm(const VectorField& field, const Particles& particles) {
    double largest = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        double norm2 = 0.0;
        for (int k = 0; k < particles.dimensions; ++k) norm2 += field[k][i] * field[k][i];
        largest = std::max(largest, norm2);
    }
    return std::sqrt(largest);
}

}  // namespace

double choose_sound_speed(const WcsphParameters& p, const Particles& particles, double spacing, double wall_speed) {
    constexpr double kCompression = 0.01;
    if (p.sound_speed > 0.0) return p.sound_speed;
    const double g = std::hypot(p.gravity[0], p.gravity[1], p.gravity[2]);
    double extent = 0.0, height = 0.0;
    for (int k = 0; k < particles.dimensions; ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const double x : particles.x[k]) {
            low = std::min(low, x);
            high = std::max(high, x);
        }
        const double along = particles.size() > 0 ? high - low + spacing : 0.0;
        extent = std::max(extent, along);
        if (g > 0.0) height += along * std::abs(p.gravity[k]) / g;
    }
    const double body = g + largest_norm(particles.a, particles);
    const double L = p.reference_length > 0.0 ? p.reference_length : (g > 0.0 ? height : extent);
    const double V = p.reference_speed > 0.0
                         ? p.reference_speed
                         : std::max({largest_norm(particles.v, particles), wall_speed, std::sqrt(2.0 * g * height)});
    const double viscous = L > 0.0 ? p.viscosity / p.rest_density * V / (L * kCompression) : 0.0;
    const double tension = p.surface_tension / (p.rest_density * spacing * kCompression);
    const double c0 = std::max({10.0 * V, std::sqrt(body * L / kCompression), std::sqrt(viscous), std::sqrt(tension)});
    return c0 > 0.0 ? c0 : 1.0;  // nothing moves it: any speed will do
}

}  // namespace headrace::solver
