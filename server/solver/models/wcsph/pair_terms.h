// What one pair gives to the acceleration of particle i, term by term: the formulas of the passes for one pair at a
// time. For what is asked rarely: forces on objects, the explanation of a particle.
#pragma once

#include "server/solver/models/wcsph/passes.h"
#include "server/solver/models/wcsph/solid_parts.h"
#include "server/solver/models/wcsph/tension_passes.h"

namespace headrace::solver {

// What the passes see, to read only.
struct WcsphView {
    const Particles& particles;
    const WcsphState& state;
    const WallParticles& walls;
    const WallState& wall_state;
    SolidView solid{};

    double volume(std::size_t i) const { return particles.m[i] / particles.rho[i]; }
};

// Which forms the terms have; as the passes are given.
struct TermOptions {
    bool is_adjoint{};
    bool is_morris{};
    PressureOptions pressure;
    ViscosityOptions viscosity;  // mu = 0: none
    bool is_continuum{};         // surface tension
    TensionOptions tension;      // sigma = 0: none
};

template <int D>
Pair<D, double> make_pair_of(const std::array<double, D>& x_ij, double V_j) {
    const double r2 = squared_distance<D, double>(x_ij);
    return {x_ij, r2, std::sqrt(r2), V_j};
}

template <int D>
class PairTerms {
  public:
    using Vector = std::array<double, D>;

    PairTerms(const WcsphView& view, const TermOptions& options) : view_(view), options_(options) {}

    Vector pressure(Index i, Index j, const Pair<D, double>& pair, double F) const {
        PressureSums<D, double> sums;
        accumulate_pressure(j, pair, F, sums);
        return pressure_acceleration(i, sums);
    }
    // What the pair adds to the sums of the pressure pass, but for the artificial viscosity.
    void accumulate_pressure(Index j, const Pair<D, double>& pair, double F, PressureSums<D, double>& sums) const {
        if (options_.is_adjoint) {
            accumulate_adjoint<D, double>(pair.V_j * F, pair.x_ij,
                                          pressure_matrix_at<D>(view_.particles, view_.state, j), sums);
        } else {
            accumulate_difference<D, double>(pair.V_j * F, pair.x_ij, view_.particles.p[j], sums);
        }
    }

    Vector wall_pressure(Index i, Index w, const Pair<D, double>& pair, double F) const {
        PressureSums<D, double> sums;
        accumulate_difference<D, double>(pair.V_j * F, pair.x_ij, static_cast<double>(view_.wall_state.p[w]), sums);
        return wall_pressure(i, sums);
    }
    Vector wall_pressure(Index i, PressureSums<D, double> sums) const {
        if (is_controlled(i) && !options_.pressure.walls_suck) sums.grad_1 = {};
        return pressure_acceleration(i, sums);
    }

    Vector own_pressure_of(Index i, const PressureSums<D, double>& fluid) const {
        if (!options_.is_adjoint) return own_pressure<D>(fluid, view_.particles.p[i]);
        return own_pressure<D>(fluid, pressure_matrix_at<D>(view_.particles, view_.state, i),
                               is_controlled(i) ? -1.0 : 1.0);
    }

    // visit(object, acceleration) for the walls without particles.
    template <class Visit>
    void for_each_solid_viscosity(Index i, Visit&& visit) const {
        WallShare<D> share;
        view_.solid.walls->find_share<D>(vector_at<D>(view_.particles.x, i), options_.viscosity.least_distance, share);
        for (int a = 0; a < share.count; ++a) {
            const Vector sum =
                solid_viscosity<D>(share.part[a], vector_at<D>(view_.particles.v, i), matrix_at<D>(view_.state.B, i));
            visit(std::size_t{share.part[a].surface->object},
                  scaled<D, double>(options_.viscosity.mu / view_.particles.rho[i], sum));
        }
    }

    Vector artificial_viscosity(Index i, Index j, const Pair<D, double>& pair, double F) const {
        const Symmetric<D> S_i = matrix_at<D>(view_.state.strain, i), S_j = matrix_at<D>(view_.state.strain, j);
        const double rate = approach_rate<D, double>(pair, velocity_difference(i, j), mean(S_i, S_j));
        return scaled<D, double>(options_.pressure.artificial_viscosity / view_.particles.rho[i] * pair.V_j * F * rate,
                                 pair.x_ij);
    }

    Vector viscosity(Index i, Index j, const Pair<D, double>& pair, double F) const {
        const Symmetric<D> B = mean(matrix_at<D>(view_.state.B, i), matrix_at<D>(view_.state.B, j));
        const double corrected = corrected_factor<D, double>(pair, F, B);
        Vector sum{};
        if (options_.is_morris) {
            accumulate_morris<D, double>(pair, corrected, velocity_difference(i, j), sum);
        } else {
            accumulate_monaghan_gingold<D, double>(pair, corrected, velocity_difference(i, j), sum);
        }
        return scaled<D, double>(options_.viscosity.mu / view_.particles.rho[i], sum);
    }

    Vector wall_viscosity(Index i, Index w, const Pair<D, double>& pair, double F) const {
        const double corrected =
            view_.wall_state.no_slip_of(w) * corrected_factor<D, double>(pair, F, matrix_at<D>(view_.state.B, i));
        const Vector v_iw = no_slip_difference<D, double>(
            pair, vector_at<D>(view_.walls.n, w), static_cast<double>(view_.walls.depth[w]),
            vector_at<D>(view_.particles.v, i), vector_or_zero<D>(view_.walls.v, w), options_.viscosity.least_distance);
        Vector sum{};
        accumulate_morris<D, double>(pair, corrected, v_iw, sum);
        return scaled<D, double>(options_.viscosity.mu / view_.particles.rho[i], sum);
    }

  private:
    static Symmetric<D> mean(const Symmetric<D>& a, const Symmetric<D>& b) {
        Symmetric<D> mean;
        for (int k = 0; k < Symmetric<D>::kSize; ++k) mean.e[k] = 0.5 * (a.e[k] + b.e[k]);
        return mean;
    }

    Vector velocity_difference(Index i, Index j) const {
        Vector v_ij;
        for (int k = 0; k < D; ++k) v_ij[k] = view_.particles.v[k][i] - view_.particles.v[k][j];
        return v_ij;
    }

    // Both forms are linear in the sums, so that of one pair is the pair's share.
    Vector pressure_acceleration(Index i, const PressureSums<D, double>& sums) const {
        const double p = view_.particles.p[i], rho = view_.particles.rho[i];
        if (!options_.is_adjoint) return difference_acceleration<D>(sums, p, matrix_at<D>(view_.state.B, i), rho);
        return adjoint_acceleration<D>(sums, pressure_matrix_at<D>(view_.particles, view_.state, i),
                                       is_controlled(i) ? -1.0 : 1.0, rho);
    }

    bool is_controlled(Index i) const {
        return options_.is_adjoint && options_.pressure.controls_tension &&
               controls_tension(view_.particles.p[i], static_cast<double>(view_.state.min_eigenvalue[i]),
                                static_cast<double>(view_.state.unevenness[i]), options_.pressure.tension_limits);
    }

    const WcsphView& view_;
    const TermOptions& options_;
};

}  // namespace headrace::solver
