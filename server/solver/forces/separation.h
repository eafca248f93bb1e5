// Coincident particles. Two particles at one point feel no pressure from each other (grad_W has no direction), and
// projections on a corner can bring any number there: in the thesis they stay superposed for ever (Fig. 2.7).
//
// Differs from the thesis: where |x_ij| < kCoincident h the pair takes the spiky kernel's slope at r = 0 with a made
// up direction e_ij, and always repels:
//     f_p,ij = |q_ij| |W'(0)| e_ij,   q_ij the pressure weight of pressure.h, W'(0) = -45/(pi h^4) in 3D.
// e_ij = -e_ji is a unit vector drawn by a hash of (smaller id, larger id, step): the momentum is conserved, runs
// repeat, and since it changes every step a pair pressed into one corner is pushed along each axis in turn: of the
// two one always moves off the wall.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "server/solver/particles.h"

namespace headrace::solver {

// Share of h below which a pair counts as coincident: its direction is then mostly rounding.
inline constexpr double kCoincident = 1e-9;

// SplitMix64 finaliser (Steele 2014); also the mixer of the state hash.
inline std::uint64_t mix(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

// e_ij, a unit vector of D components with e_ij = -e_ji. Precondition: i != j.
template <int D>
std::array<double, D> separation_direction(Index i, Index j, std::uint64_t step) {
    const auto [low, high] = std::minmax(i, j);
    std::uint64_t state = mix(mix((std::uint64_t{low} << 32) | high) ^ step);
    std::array<double, D> e{};
    double length2 = 0.0;
    for (double& component : e) {
        state = mix(state);
        // in (-1, 1) and never 0: an odd multiple of 2^-53
        component =
            static_cast<double>(static_cast<std::int64_t>(state >> 11) * 2 + 1 - (std::int64_t{1} << 53)) * 0x1p-53;
        length2 += component * component;
    }
    const double scale = (i < j ? 1.0 : -1.0) / std::sqrt(length2);
    for (double& component : e) component *= scale;
    return e;
}

}  // namespace headrace::solver
