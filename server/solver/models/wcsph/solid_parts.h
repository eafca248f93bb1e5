// One part of the walls without particles: what it does to a particle near it.
#pragma once

#include "server/solver/boundaries/integral_walls.h"

namespace headrace::solver {

// v - v_wall at a part: a belt runs along its surface.
template <int D>
std::array<double, D> velocity_past(const WallPart<D>& part, const std::array<double, D>& v) {
    std::array<double, D> wall;
    for (int k = 0; k < D; ++k) wall[k] = part.surface->v[k];
    const double into = dot<D, double>(wall, part.n);
    std::array<double, D> past;
    for (int k = 0; k < D; ++k) past[k] = v[k] - (wall[k] - into * part.n[k]);
    return past;
}

// No-slip viscosity, to be multiplied by mu/rho_i (forces/laminar_viscosity.h, Morris's form).
template <int D>
std::array<double, D> solid_viscosity(const WallPart<D>& part, const std::array<double, D>& v, const Symmetric<D>& B) {
    if (!part.surface->no_slip) return {};
    double factor = 0.0;
    for (int k = 0; k < D; ++k) {
        for (int l = k; l < D; ++l) factor += (k == l ? 1.0 : 2.0) * B(k, l) * part.viscous[Symmetric<D>::index(k, l)];
    }
    return scaled<D, double>(2.0 * factor, velocity_past<D>(part, v));
}

}  // namespace headrace::solver
