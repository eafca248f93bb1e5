#include "server/solver/models/wcsph/loads.h"

#include <cmath>

namespace headrace::solver {
namespace {

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Adds the force of the pair: fluid particle i, displaced to `x` by its periods, and dummy w.
template <int D>
void accumulate_pair(const LoadInput& in, const WcsphView& view, const WcsphSums& sums, const TermOptions& options,
                     Index w, Index i, const Vec3& x, WallForce& force) {
    std::array<double, D> x_ij;
    for (int k = 0; k < D; ++k) x_ij[k] = x[k] - view.walls.x[k][w];
    const Pair<D, double> pair = make_pair_of<D>(x_ij, view.walls.V[w]);
    if (pair.r >= in.support) return;
    if (in.thin_walls != nullptr && !in.thin_walls->sees(x, w)) return;
    const PairTerms<D> terms(view, options);
    const double F = sums.F(pair.r), m = view.particles.m[i];
    Vec3 both{};
    const std::array<double, D> pressure = terms.wall_pressure(i, w, pair, F);
    for (int k = 0; k < D; ++k) {
        force.pressure[k] += m * pressure[k];
        both[k] = m * pressure[k];
    }
    if (options.viscosity.mu > 0.0 && view.wall_state.no_slip_of(w) > 0.0) {
        const std::array<double, D> viscosity = terms.wall_viscosity(i, w, pair, F);
        for (int k = 0; k < D; ++k) {
            force.viscosity[k] += m * viscosity[k];
            both[k] += m * viscosity[k];
        }
    }
    const Vec3 torque = cross(x, both);
    for (int k = 0; k < 3; ++k) force.torque[k] += torque[k];
}

template <int D>
std::vector<WallForce> compute_forces(const LoadInput& in, const WcsphView& view, const WcsphSums& sums,
                                      const TermOptions& options) {
    std::vector<WallForce> forces(view.walls.size());
    in.neighbours->for_each_wall_pair([&](Index w, Index i) {
        Vec3 x{};
        for (int k = 0; k < D; ++k) {
            x[k] = view.particles.x[k][i];
            if (in.domain.periodic[k]) {
                const double period = in.domain.max[k] - in.domain.min[k];
                x[k] -= period * std::round((x[k] - view.walls.x[k][w]) / period);
            }
        }
        accumulate_pair<D>(in, view, sums, options, w, i, x, forces[w]);
    });
    return forces;
}

}  // namespace

std::vector<WallForce> compute_wall_forces(const LoadInput& in, const WcsphView& view, const WcsphSums& sums,
                                           const TermOptions& options) {
    if (view.walls.size() == 0 || view.particles.size() == 0) return std::vector<WallForce>(view.walls.size());
    return view.particles.dimensions == 2 ? compute_forces<2>(in, view, sums, options)
                                          : compute_forces<3>(in, view, sums, options);
}

std::vector<ObjectLoad> sum_object_loads(const WallParticles& walls, const std::vector<WallForce>& forces,
                                         std::size_t objects) {
    std::vector<ObjectLoad> loads(objects);
    for (std::size_t w = 0; w < forces.size(); ++w) {
        ObjectLoad& load = loads[walls.object[w]];
        for (int k = 0; k < 3; ++k) {
            load.force[k] -= forces[w].pressure[k] + forces[w].viscosity[k];
            load.torque[k] -= forces[w].torque[k];
        }
    }
    return loads;
}

WallPower compute_wall_power(const WallParticles& walls, const std::vector<WallForce>& forces) {
    WallPower power;
    if (walls.v[0].empty()) return power;
    for (std::size_t w = 0; w < forces.size(); ++w) {
        for (int k = 0; k < walls.dimensions; ++k) {
            power.pressure += forces[w].pressure[k] * walls.v[k][w];
            power.viscosity += forces[w].viscosity[k] * walls.v[k][w];
        }
    }
    return power;
}

}  // namespace headrace::solver
