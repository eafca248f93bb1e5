#include "server/solver/diagnostics.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "server/solver/forces/separation.h"
#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

double speed_squared(const Particles& particles, std::size_t i) {
    double sum = 0.0;
    for (int k = 0; k < particles.dimensions; ++k) sum += particles.v[k][i] * particles.v[k][i];
    return sum;
}

struct Sums {
    double max_speed2{};      // [m^2/s^2]
    double m_speed2{};        // [J] sum of m v^2
    double m_g_x{};           // [J] sum of m g.x
    double rho{}, max_rho{};  // [kg/m^3]
};

}  // namespace

Diagnostics compute_diagnostics(const Particles& particles, const Vec3& gravity) {
    const Sums sums = parallel_reduce(
        particles.size(), Sums{},
        [&](std::size_t begin, std::size_t end) {
            Sums block;
            for (std::size_t i = begin; i < end; ++i) {
                const double speed2 = speed_squared(particles, i);
                block.max_speed2 = std::max(block.max_speed2, speed2);
                block.m_speed2 += particles.m[i] * speed2;
                for (int k = 0; k < particles.dimensions; ++k)
                    block.m_g_x += particles.m[i] * gravity[k] * particles.x[k][i];
                block.rho += particles.rho[i];
                block.max_rho = std::max(block.max_rho, particles.rho[i]);
            }
            return block;
        },
        [](const Sums& a, const Sums& b) {
            return Sums{std::max(a.max_speed2, b.max_speed2), a.m_speed2 + b.m_speed2, a.m_g_x + b.m_g_x, a.rho + b.rho,
                        std::max(a.max_rho, b.max_rho)};
        });
    const double count = static_cast<double>(std::max<std::size_t>(particles.size(), 1));
    return {std::sqrt(sums.max_speed2), 0.5 * sums.m_speed2, -sums.m_g_x, sums.rho / count, sums.max_rho};
}

double compute_slow_share(const Particles& particles, double speed) {
    if (particles.size() == 0) return 1.0;
    const std::size_t slow = parallel_reduce(
        particles.size(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::size_t block = 0;
            for (std::size_t i = begin; i < end; ++i) block += speed_squared(particles, i) < speed * speed;
            return block;
        },
        [](std::size_t a, std::size_t b) { return a + b; });
    return static_cast<double>(slow) / static_cast<double>(particles.size());
}

std::uint64_t compute_state_hash(const Particles& particles) {
    return parallel_reduce(
        particles.size(), std::uint64_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::uint64_t block = 0;
            for (std::size_t i = begin; i < end; ++i) {
                std::uint64_t s = particles.id[i];
                const VectorField& carried = particles.v_half[0].empty() ? particles.v : particles.v_half;
                for (const VectorField* field : {&particles.x, &carried}) {
                    for (int k = 0; k < particles.dimensions; ++k)
                        s = mix(s ^ std::bit_cast<std::uint64_t>((*field)[k][i]));
                }
                block += mix(s);
            }
            return block;
        },
        [](std::uint64_t a, std::uint64_t b) { return a + b; });
}

}  // namespace headrace::solver
