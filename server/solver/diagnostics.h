// Whole-field quantities: energies, density statistics, state hash, share of slow particles. Each is a fixed-order
// reduction: the same bits for any number of threads.
#pragma once

#include <cstdint>

#include "server/solver/particles.h"

namespace headrace::solver {

struct Diagnostics {
    double max_speed{};         // [m/s]
    double kinetic_energy{};    // [J], sum of m v^2 / 2 (2D: per metre)
    double potential_energy{};  // [J], -sum of m g.x
    double mean_density{};      // [kg/m^3]
    double max_density{};       // [kg/m^3]
};

Diagnostics compute_diagnostics(const Particles& particles, const Vec3& gravity);

// Share (0..1) of particles with |v| < speed [m/s].
double compute_slow_share(const Particles& particles, double speed);

// State hash: sum modulo 2^64 over the particles of a hash of the words (id, x, v_half), v for models without leap
// velocity, doubles taken as their 64 bits; independent of storage order, so it equals the hash taken in id order.
// Definition in proto/README.md:
//   s = id;  for each word w of x[0..d-1], v_half[0..d-1]:  s = mix(s ^ w);   H += mix(s)
//   mix(z) is SplitMix64's finaliser: z += 0x9e3779b97f4a7c15; z = (z ^ z>>30) * 0xbf58476d1ce4e5b9;
//   z = (z ^ z>>27) * 0x94d049bb133111eb; z ^ z>>31
std::uint64_t compute_state_hash(const Particles& particles);

}  // namespace headrace::solver
