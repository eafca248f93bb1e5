// A kernel summed over the solid behind a flat or round wall, in the distance d of the point from its surface.
//
// With y = x' - x, n the wall's normal into the fluid, t an axis along the wall and grad W = -F y:
//   integral of grad W           = -w n
//   integral of y (x) grad W     = m_n n n + m_t (1 - n n)
//   integral of F y y/r^2        = k_n n n + k_t (1 - n n);  with the depth below the surface as a factor: l_n, l_t
// Of a flat wall m_t is the kernel's weight in the solid and m_n = m_t + d w (divergence theorem).
//
// The integrals are sums over layers as thick as the fluid's spacing, flat ones over its lattice (kernel_sections.h):
// the fluid's own sums go on into the solid. Finer layers come to the integrals themselves; beside the fluid's sums
// these would not balance: a lattice at rest on a wall would be off by dx^2/24 times the slope of w, 3 % of 1/dx in 3D
// with R = 3 dx, and rearrange itself.
#pragma once

#include <vector>

#include "server/solver/boundaries/kernel_sections.h"

namespace headrace::solver {

struct WallProfile {
    double w{};           // [1/m]
    double m_n{}, m_t{};  // [1]
    double w_shifted{};   // [1/m] w of the shifting's kernel
};

// What is asked for more rarely.
struct ViscousProfile {
    double gamma{};       // [1] integral of W
    double k_n{}, k_t{};  // [m^-2]
    double l_n{}, l_t{};  // [1/m]
};

struct WallProfileTable {
    LinearTable<WallProfile> plain;
    LinearTable<ViscousProfile> viscous;
};

// Midpoints of layers this thick [m].
struct WallLayers {
    double thickness{};
    int count{};
    double depth(int k) const { return (k + 0.5) * thickness; }
};
WallLayers make_wall_layers(double thickness, double support);

// Distances from -thickness, for points that have sunk in a little, to the support.
WallProfileTable make_plane_profile(const SectionKernel& kernel, const WallLayers& layers);

// A sphere, in 2D a disc. is_container: the solid is outside.
WallProfileTable make_sphere_profile(const SectionKernel& kernel, const WallLayers& layers, double radius,
                                     bool is_container);

}  // namespace headrace::solver
