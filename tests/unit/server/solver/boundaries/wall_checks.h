// What the tests of walls share: Wendland's C2 kernel, lattices of fluid, and sums over all that a point sees.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "server/solver/boundaries/rigid_motion.h"
#include "server/solver/boundaries/wall_particles.h"

namespace headrace::solver {

constexpr double kDx = 0.1;             // [m]
constexpr double kSupport = 3.0 * kDx;  // [m]

// (1 - q)^4 (1 + 4 q), q = r / R; 7/(pi R^2) in 2D, 21/(2 pi R^3) in 3D (Wendland 1995).
inline double wendland(int dimensions, double r) {
    if (r >= kSupport) return 0.0;
    const double q = r / kSupport, pi = std::numbers::pi;
    const double factor =
        dimensions == 2 ? 7.0 / (pi * kSupport * kSupport) : 10.5 / (pi * kSupport * kSupport * kSupport);
    return factor * std::pow(1.0 - q, 4) * (1.0 + 4.0 * q);
}

inline double kernel_at(int dimensions, const Vec3& a, const Vec3& b) {
    return wendland(dimensions, rigid::length(rigid::minus(a, b)));
}

// The sum over an endless lattice at one of its points.
inline double lattice_sum(int dimensions) {
    double sum = 0.0;
    for (int i = -3; i <= 3; ++i) {
        for (int j = -3; j <= 3; ++j) {
            for (int k = dimensions == 3 ? -3 : 0; k <= (dimensions == 3 ? 3 : 0); ++k) {
                sum += wendland(dimensions, kDx * std::sqrt(i * i + j * j + k * k));
            }
        }
    }
    return sum * std::pow(kDx, dimensions);
}

// Lattice points at (i + 1/2) dx in [min, max] where is_fluid.
template <class IsFluid>
std::vector<Vec3> fluid_lattice(int dimensions, const Vec3& min, const Vec3& max, IsFluid&& is_fluid) {
    std::array<int, 3> n{1, 1, 1};
    for (int k = 0; k < dimensions; ++k) n[k] = static_cast<int>(std::lround((max[k] - min[k]) / kDx));
    std::vector<Vec3> points;
    for (int k = 0; k < n[2]; ++k) {
        for (int j = 0; j < n[1]; ++j) {
            for (int i = 0; i < n[0]; ++i) {
                Vec3 x{min[0] + (i + 0.5) * kDx, min[1] + (j + 0.5) * kDx, 0.0};
                if (dimensions == 3) x[2] = min[2] + (k + 0.5) * kDx;
                if (is_fluid(x)) points.push_back(x);
            }
        }
    }
    return points;
}

inline Vec3 position_of(const WallParticles& particles, std::size_t k) {
    return {particles.x[0][k], particles.x[1][k], particles.dimensions == 3 ? particles.x[2][k] : 0.0};
}

// b as the image nearest to a.
inline Vec3 nearest(const Domain& domain, const Vec3& a, Vec3 b) {
    for (int k = 0; k < 3; ++k) {
        const double period = domain.max[k] - domain.min[k];
        if (domain.periodic[k]) b[k] -= period * std::round((b[k] - a[k]) / period);
    }
    return b;
}

// sum V W over the fluid and the dummies that a fluid particle at x sees.
inline double total_sum(const Walls& walls, const Domain& domain, const std::vector<Vec3>& fluid, const Vec3& x) {
    const WallParticles& particles = walls.particles();
    const int dimensions = particles.dimensions;
    double sum = 0.0;
    for (const Vec3& y : fluid) {
        if (!walls.is_blocked(x, y)) sum += std::pow(kDx, dimensions) * kernel_at(dimensions, x, nearest(domain, x, y));
    }
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const double W = kernel_at(dimensions, x, nearest(domain, x, position_of(particles, k)));
        if (W > 0.0 && walls.sees(x, k)) sum += particles.V[k] * W;
    }
    return sum;
}

// Largest difference from the endless lattice's sum over the points `where`.
inline double worst_sum_error(const Walls& walls, const Domain& domain, const std::vector<Vec3>& fluid,
                              const std::vector<Vec3>& where) {
    const double full = lattice_sum(walls.particles().dimensions);
    double worst = 0.0;
    for (const Vec3& x : where) worst = std::max(worst, std::abs(total_sum(walls, domain, fluid, x) - full));
    return worst;
}

inline CollisionObject wall(Primitive shape, Role role = Role::obstacle) {
    CollisionObject object;
    object.name = "wall";
    object.role = role;
    object.shape = shape;
    return object;
}

inline Walls make_walls(int dimensions, const std::vector<CollisionObject>& objects, const Domain& domain,
                        double t = 0.0) {
    Walls walls(dimensions, kDx, kSupport);
    walls.rebuild(objects, domain, t);
    return walls;
}

inline Box box_between(const Vec3& min, const Vec3& max) {
    Box box;
    for (int k = 0; k < 3; ++k) {
        box.center[k] = 0.5 * (min[k] + max[k]);
        box.half_extent[k] = 0.5 * (max[k] - min[k]);
    }
    return box;
}

// Round-off of some hundred terms, each exact to a few units in the last place of coordinates near 1.
constexpr double kRoundOff = 1e-12;
constexpr double kSingle = 2e-7;  // rounding of normals and depths, which are stored in single precision

}  // namespace headrace::solver
