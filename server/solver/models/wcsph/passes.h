// The passes of the wcsph model: which fields a loop reads, which terms it sums, what it writes. Formulas are in
// forces/ and boundaries/; the loop is pair_loop.h.
#pragma once

#include "server/solver/boundaries/wall_state.h"
#include "server/solver/forces/artificial_viscosity.h"
#include "server/solver/forces/continuity.h"
#include "server/solver/forces/density_diffusion.h"
#include "server/solver/forces/gradient_correction.h"
#include "server/solver/forces/laminar_viscosity.h"
#include "server/solver/forces/pressure_gradient.h"
#include "server/solver/forces/separation.h"
#include "server/solver/forces/shifting.h"
#include "server/solver/models/wcsph/state.h"
#include "server/solver/pair_loop.h"

namespace headrace::solver {

template <int D>
HEADRACE_ALWAYS_INLINE std::array<double, D> vector_at(const VectorField& field, std::size_t i) {
    std::array<double, D> u;
    for (int k = 0; k < D; ++k) u[k] = field[k][i];
    return u;
}

template <int D>
HEADRACE_ALWAYS_INLINE void write_vector(VectorField& field, std::size_t i, const std::array<double, D>& u) {
    for (int k = 0; k < D; ++k) field[k][i] = u[k];
}

template <int D>
HEADRACE_ALWAYS_INLINE Symmetric<D> matrix_at(const MatrixField& field, std::size_t i) {
    Symmetric<D> m;
    for (int k = 0; k < Symmetric<D>::kSize; ++k) m.e[k] = field[k][i];
    return m;
}

template <int D>
HEADRACE_ALWAYS_INLINE void write_matrix(MatrixField& field, std::size_t i, const Symmetric<D>& m) {
    for (int k = 0; k < Symmetric<D>::kSize; ++k) field[k][i] = m.e[k];
}

template <std::size_t N>
HEADRACE_ALWAYS_INLINE std::array<double, N> sum_lanes(const std::array<Lanes, N>& lanes) {
    std::array<double, N> sums;
    for (std::size_t k = 0; k < N; ++k) sums[k] = sum_lanes(lanes[k]);
    return sums;
}

// Fields first..first+N-1 of the neighbours.
template <int N, class Neighbour>
HEADRACE_ALWAYS_INLINE std::array<Lanes, N> lanes_of(const Neighbour& neighbour, std::size_t first) {
    std::array<Lanes, N> u;
    for (int k = 0; k < N; ++k) u[k] = neighbour(first + k);
    return u;
}

template <int D>
HEADRACE_ALWAYS_INLINE std::array<Lanes, D> minus(const std::array<double, D>& a, const std::array<Lanes, D>& b) {
    std::array<Lanes, D> difference;
    for (int k = 0; k < D; ++k) difference[k] = a[k] - b[k];
    return difference;
}

template <int D>
HEADRACE_ALWAYS_INLINE Symmetric<D, Lanes> splat(const Symmetric<D>& m) {
    Symmetric<D, Lanes> lanes;
    for (int k = 0; k < Symmetric<D>::kSize; ++k) lanes.e[k] = splat<Lanes>(m.e[k]);
    return lanes;
}

// What all passes see.
struct PassData {
    Particles& particles;
    WcsphState& state;
    const WallParticles& walls;
    WallState& wall_state;
};

// ---- once per advective step: moment matrix, surface, gradients, shift ----------------------------------------------

inline constexpr double kGradientEigenvalue = 0.3;  // from which a gradient is corrected

struct GeometryOptions {
    double correction_threshold{};  // smallest eigenvalue that is corrected
    bool shifting{};
    bool reconstructs{};        // the strain rate is wanted
    double shift_factor{};      // C dt 2h [m s]
    double shift_speed{};       // [m/s] U of every particle, beside that of its strain rate
    double strain_length{};     // [m] U = strain_length |grad v|
    double W_dx{};              // W at one spacing
    double dynamic_pressure{};  // rho0 U^2 [Pa]
    double noise{};             // [s] length of a random displacement added to the shift, over U
    std::uint64_t step{};       // drives its direction
    ShiftingLimits limits;
};

// HasGradients: velocity gradients, and what follows from them: the shift and the strain rate.
template <int D, class Kernel, bool HasGradients>
struct GeometryPass {
    static constexpr bool kReadsWalls = true;
    static constexpr std::size_t kFluidFields = HasGradients ? 1 + D : 1;
    static constexpr std::size_t kWallFields = HasGradients ? 2 + 2 * D : 1;  // delta, v, n, no_slip

    Kernel kernel;
    PassData data;
    GeometryOptions options;

    struct Self {
        double delta;
        std::array<double, D> v;
    };
    struct Sums {
        Symmetric<D, Lanes> M;
        std::array<Lanes, D> grad_1{}, shift{}, grad_delta{};
        std::array<std::array<Lanes, D>, D> grad_v{};
    };

    std::array<const double*, kFluidFields> fluid_fields() const {
        std::array<const double*, kFluidFields> fields;
        fields[0] = data.state.delta.data();
        if constexpr (HasGradients) {
            for (int k = 0; k < D; ++k) fields[1 + k] = data.particles.v[k].data();
        }
        return fields;
    }
    std::array<const double*, kWallFields> wall_fields() const {
        std::array<const double*, kWallFields> fields;
        fields[0] = data.wall_state.delta.data();
        if constexpr (HasGradients) {
            for (int k = 0; k < D; ++k) {
                fields[1 + k] = data.walls.v[k].data();
                fields[1 + D + k] = data.walls.n[k].data();
            }
            fields[1 + 2 * D] = data.wall_state.no_slip.data();
        }
        return fields;
    }

    HEADRACE_ALWAYS_INLINE Self load(Index i) const { return {data.state.delta[i], vector_at<D>(data.particles.v, i)}; }

    template <bool IsWall, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const Pair<D, Lanes>& pair, const Neighbour& neighbour,
                                     Sums& sums) const {
        const Lanes F = kernel.F(pair.r);
        accumulate_moment<D, Lanes>(pair, F, sums.M);
        const std::array<Lanes, D> grad = scaled<D, Lanes>(pair.V_j * F, pair.x_ij);
        add_to<D, Lanes>(sums.grad_1, grad);
        add_to<D, Lanes>(sums.grad_delta, scaled<D, Lanes>(neighbour(0) - self.delta, grad));
        if constexpr (HasGradients) {
            const Lanes W = kernel.W(pair.r) * (1.0 / options.W_dx);
            add_to<D, Lanes>(sums.shift, scaled<D, Lanes>(shifting_factor<D, Lanes>(pair, F, W), pair.x_ij));
            std::array<Lanes, D> v_ij = minus<D>(self.v, lanes_of<D>(neighbour, 1));
            if constexpr (IsWall) {
                // A slippery wall says nothing about the tangential velocity.
                const std::array<Lanes, D> n = lanes_of<D>(neighbour, 1 + D);
                const Lanes slides = 1.0 - neighbour(1 + 2 * D), normal = dot<D, Lanes>(v_ij, n);
                for (int k = 0; k < D; ++k) v_ij[k] += slides * (normal * n[k] - v_ij[k]);
            }
            for (int k = 0; k < D; ++k) {
                for (int l = 0; l < D; ++l) sums.grad_v[k][l] -= v_ij[k] * grad[l];
            }
        }
    }

    // Row k: the corrected gradient of v_k [1/s]; 0 where too little is around to tell.
    static std::array<std::array<double, D>, D> velocity_gradient(const Sums& sums, const Symmetric<D>& L,
                                                                  double eigenvalue) {
        std::array<std::array<double, D>, D> grad_v{};
        if (eigenvalue < kGradientEigenvalue) return grad_v;
        for (int k = 0; k < D; ++k) grad_v[k] = L * sum_lanes(sums.grad_v[k]);
        return grad_v;
    }

    HEADRACE_ALWAYS_INLINE void store(Index i, const Self&, const Sums& sums) const {
        WcsphState& state = data.state;
        Symmetric<D> M;
        M.e = sum_lanes(sums.M.e);
        const double eigenvalue = smallest_eigenvalue(M);
        const Symmetric<D> B = correction_matrix<D>(M, eigenvalue, options.correction_threshold);
        const std::array<double, D> normal = sum_lanes(sums.grad_1);
        // Gradients may be corrected far nearer to a free surface than forces.
        const Symmetric<D> L = correction_matrix<D>(M, eigenvalue, kGradientEigenvalue);
        const std::array<double, D> grad_delta = L * sum_lanes(sums.grad_delta);
        state.min_eigenvalue[i] = eigenvalue;
        write_matrix<D>(state.B, i, B);
        write_vector<D>(state.normal, i, normal);
        write_vector<D>(state.grad_delta, i, grad_delta);
        if constexpr (HasGradients) {
            const auto grad_v = velocity_gradient(sums, L, eigenvalue);
            double grad2 = 0.0;
            for (const auto& row : grad_v) grad2 += dot<D, double>(row, row);
            const double U = (options.shift_speed + options.strain_length * std::sqrt(grad2)) *
                             shifting_need(options.dynamic_pressure, data.particles.p[i]);
            std::array<double, D> dx = sum_lanes(sums.shift);
            for (double& component : dx) component *= -options.shift_factor * U;
            if (options.noise > 0.0 && eigenvalue > options.limits.surface_eigenvalue) {
                const std::array<double, D> e =
                    separation_direction<D>(data.particles.id[i], 0xffffffffu, options.step);
                for (int k = 0; k < D; ++k) dx[k] += options.noise * U * e[k];
            }
            dx = limit_shift<D>(dx, eigenvalue, normal, options.limits);
            std::array<double, D> dv;
            for (int k = 0; k < D; ++k) dv[k] = dot<D, double>(grad_v[k], dx);
            Symmetric<D> strain;
            for (int r = 0; r < D; ++r) {
                for (int c = r; c < D; ++c)
                    strain(r, c) = options.reconstructs ? 0.5 * (grad_v[r][c] + grad_v[c][r]) : 0.0;
            }
            write_matrix<D>(state.strain, i, strain);
            write_vector<D>(state.dx, i, dx);
            write_vector<D>(state.dv, i, dv);
            state.ddelta[i] = dot<D, double>(grad_delta, dx);
        }
    }
};

// ---- acoustic step: mass --------------------------------------------------------------------------------------------

struct ContinuityOptions {
    double diffusion{};  // xi h c0 [m^2/s]
    Vec3 g_over_c2{};    // [1/m] g/c0^2; 0: no hydrostatic part
};

template <int D, class Kernel, DensityDiffusion Diffusion>
struct ContinuityPass {
    static constexpr bool kIsDiffusive = Diffusion != DensityDiffusion::none;
    static constexpr bool kIsAntuono = Diffusion == DensityDiffusion::antuono;
    static constexpr bool kReadsWalls = true;
    static constexpr std::size_t kFluidFields = D + (kIsDiffusive ? 1 : 0) + (kIsAntuono ? D : 0);
    static constexpr std::size_t kWallFields = D;

    Kernel kernel;
    PassData data;
    ContinuityOptions options;

    struct Self {
        double delta;
        std::array<double, D> v, grad_delta;
        Symmetric<D, Lanes> B;
    };
    struct Sums {
        Lanes divergence{}, diffusion{};
    };

    std::array<const double*, kFluidFields> fluid_fields() const {
        std::array<const double*, kFluidFields> fields;
        for (int k = 0; k < D; ++k) {
            fields[k] = data.particles.v[k].data();
            if constexpr (kIsAntuono) fields[D + 1 + k] = data.state.grad_delta[k].data();
        }
        if constexpr (kIsDiffusive) fields[D] = data.state.delta.data();
        return fields;
    }
    std::array<const double*, kWallFields> wall_fields() const {
        std::array<const double*, kWallFields> fields;
        for (int k = 0; k < D; ++k) fields[k] = data.walls.v[k].data();
        return fields;
    }

    HEADRACE_ALWAYS_INLINE Self load(Index i) const {
        return {data.state.delta[i], vector_at<D>(data.particles.v, i), vector_at<D>(data.state.grad_delta, i),
                splat<D>(matrix_at<D>(data.state.B, i))};
    }

    template <bool IsWall, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const Pair<D, Lanes>& pair, const Neighbour& neighbour,
                                     Sums& sums) const {
        const Lanes F = kernel.F(pair.r);
        const std::array<Lanes, D> v_ij = minus<D>(self.v, lanes_of<D>(neighbour, 0));
        sums.divergence += velocity_divergence<D, Lanes>(pair.V_j, F, self.B * pair.x_ij, v_ij);
        if constexpr (kIsDiffusive && !IsWall) {
            const Lanes delta_ji = neighbour(D) - self.delta;
            if constexpr (kIsAntuono) {
                std::array<Lanes, D> sum_grad = lanes_of<D>(neighbour, D + 1);
                for (int k = 0; k < D; ++k) sum_grad[k] += self.grad_delta[k];
                sums.diffusion += antuono_diffusion<D, Lanes>(pair, F, delta_ji, sum_grad);
            } else {
                Lanes delta_H{};
                for (int k = 0; k < D; ++k) delta_H -= options.g_over_c2[k] * pair.x_ij[k];
                sums.diffusion += plain_diffusion<D, Lanes>(pair, F, delta_ji, delta_H);
            }
        }
    }

    HEADRACE_ALWAYS_INLINE void store(Index i, const Self& self, const Sums& sums) const {
        double rate = -(1.0 + self.delta) * sum_lanes(sums.divergence);
        if constexpr (kIsDiffusive) rate += options.diffusion * sum_lanes(sums.diffusion);
        data.state.delta_rate[i] = rate;
    }
};

// ---- acoustic step: momentum ----------------------------------------------------------------------------------------

struct PressureOptions {
    double artificial_viscosity{};  // alpha h c0 rho0 [Pa s]
    bool controls_tension{};
    double tension_eigenvalue{};  // tension is controlled where the smallest eigenvalue exceeds this
    bool walls_suck{};            // may their pressure be negative?
};

template <int D, class Kernel, bool IsAdjoint, bool HasAlpha>
struct PressurePass {
    static constexpr bool kReadsWalls = true;
    static constexpr std::size_t kPressureFields = IsAdjoint ? symmetric_size(D) : 1;
    static constexpr std::size_t kFluidFields = kPressureFields + (HasAlpha ? D + symmetric_size(D) : 0);
    static constexpr std::size_t kWallFields = 1;

    Kernel kernel;
    PassData data;
    PressureOptions options;

    struct Self {
        double p, rho;
        std::array<double, D> v;
        Symmetric<D> strain;
    };
    struct Sums {
        PressureSums<D, Lanes> fluid, walls;
        std::array<Lanes, D> artificial{};
    };

    std::array<const double*, kFluidFields> fluid_fields() const {
        std::array<const double*, kFluidFields> fields;
        if constexpr (IsAdjoint) {
            for (std::size_t k = 0; k < kPressureFields; ++k) fields[k] = data.state.pB[k].data();
        } else {
            fields[0] = data.particles.p.data();
        }
        if constexpr (HasAlpha) {
            for (int k = 0; k < D; ++k) fields[kPressureFields + k] = data.particles.v[k].data();
            for (int k = 0; k < symmetric_size(D); ++k) fields[kPressureFields + D + k] = data.state.strain[k].data();
        }
        return fields;
    }
    std::array<const double*, kWallFields> wall_fields() const { return {data.wall_state.p.data()}; }

    HEADRACE_ALWAYS_INLINE Self load(Index i) const {
        return {data.particles.p[i], data.particles.rho[i], vector_at<D>(data.particles.v, i),
                matrix_at<D>(data.state.strain, i)};
    }

    template <bool IsWall, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const Pair<D, Lanes>& pair, const Neighbour& neighbour,
                                     Sums& sums) const {
        const Lanes F = kernel.F(pair.r);
        const std::array<Lanes, D> grad = scaled<D, Lanes>(pair.V_j * F, pair.x_ij);
        if constexpr (IsWall) {
            accumulate_difference<D, Lanes>(grad, neighbour(0), sums.walls);
        } else {
            if constexpr (IsAdjoint) {
                Symmetric<D, Lanes> pB_j;
                pB_j.e = lanes_of<static_cast<int>(kPressureFields)>(neighbour, 0);
                accumulate_adjoint<D, Lanes>(grad, pB_j, sums.fluid);
            } else {
                accumulate_difference<D, Lanes>(grad, neighbour(0), sums.fluid);
            }
            if constexpr (HasAlpha) {
                const std::array<Lanes, D> v_ij = minus<D>(self.v, lanes_of<D>(neighbour, kPressureFields));
                Symmetric<D, Lanes> mean_strain;
                for (int k = 0; k < symmetric_size(D); ++k)
                    mean_strain.e[k] = 0.5 * (self.strain.e[k] + neighbour(kPressureFields + D + k));
                add_to<D, Lanes>(sums.artificial,
                                 scaled<D, Lanes>(approach_factor<D, Lanes>(pair, F, v_ij, mean_strain), pair.x_ij));
            }
        }
    }

    HEADRACE_ALWAYS_INLINE void store(Index i, const Self& self, const Sums& sums) const {
        PressureSums<D, double> total{sum_lanes(sums.fluid.grad_1), sum_lanes(sums.fluid.pB_grad)};
        const std::array<double, D> wall_1 = sum_lanes(sums.walls.grad_1), wall_p = sum_lanes(sums.walls.pB_grad);
        const Symmetric<D> B = matrix_at<D>(data.state.B, i);
        const bool is_controlled = IsAdjoint && options.controls_tension && self.p < 0.0 &&
                                   data.state.min_eigenvalue[i] > options.tension_eigenvalue;
        // Where walls do not suck, controlled tension would push the particle off the wall, the more the further it
        // goes: it ends at the fluid.
        if (!is_controlled || options.walls_suck) add_to<D, double>(total.grad_1, wall_1);
        // A wall particle has B = 1: with the fluid particle's, walls would feed energy into still water.
        add_to<D, double>(total.pB_grad, wall_p);
        std::array<double, D> a;
        if constexpr (IsAdjoint) {
            a = adjoint_acceleration<D>(total, matrix_at<D>(data.state.pB, i), is_controlled ? -1.0 : 1.0, self.rho);
        } else {
            a = difference_acceleration<D>(total, self.p, B, self.rho);
        }
        if constexpr (HasAlpha) {
            const std::array<double, D> artificial = sum_lanes(sums.artificial);
            for (int k = 0; k < D; ++k) a[k] += options.artificial_viscosity / self.rho * artificial[k];
        }
        for (int k = 0; k < D; ++k) data.particles.a[k][i] = a[k] + data.state.a_slow[k][i];
    }
};

// ---- once per advective step: viscosity -----------------------------------------------------------------------------

struct ViscosityOptions {
    double mu{};              // [Pa s]
    double least_distance{};  // [m] of fluid from a no-slip wall
};

// Adds to a_slow.
template <int D, class Kernel, bool IsMorris>
struct ViscosityPass {
    static constexpr bool kReadsWalls = true;
    static constexpr std::size_t kMatrix = symmetric_size(D);
    static constexpr std::size_t kFluidFields = D + kMatrix;
    static constexpr std::size_t kWallFields = 2 * D + 2;  // v, n, depth, no_slip

    Kernel kernel;
    PassData data;
    ViscosityOptions options;

    struct Self {
        std::array<double, D> v;
        Symmetric<D> B;
    };
    struct Sums {
        std::array<Lanes, D> a{};
    };

    std::array<const double*, kFluidFields> fluid_fields() const {
        std::array<const double*, kFluidFields> fields;
        for (int k = 0; k < D; ++k) fields[k] = data.particles.v[k].data();
        for (std::size_t k = 0; k < kMatrix; ++k) fields[D + k] = data.state.B[k].data();
        return fields;
    }
    std::array<const double*, kWallFields> wall_fields() const {
        std::array<const double*, kWallFields> fields;
        for (int k = 0; k < D; ++k) {
            fields[k] = data.walls.v[k].data();
            fields[D + k] = data.walls.n[k].data();
        }
        fields[2 * D] = data.walls.depth.data();
        fields[2 * D + 1] = data.wall_state.no_slip.data();
        return fields;
    }

    HEADRACE_ALWAYS_INLINE Self load(Index i) const {
        return {vector_at<D>(data.particles.v, i), matrix_at<D>(data.state.B, i)};
    }

    template <bool IsWall, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const Pair<D, Lanes>& pair, const Neighbour& neighbour,
                                     Sums& sums) const {
        Symmetric<D, Lanes> B = splat<D>(self.B);
        std::array<Lanes, D> v_ij;
        Lanes weight = splat<Lanes>(1.0);
        if constexpr (IsWall) {
            std::array<Lanes, D> v_i;
            for (int k = 0; k < D; ++k) v_i[k] = splat<Lanes>(self.v[k]);
            v_ij = no_slip_difference<D, Lanes>(pair, lanes_of<D>(neighbour, D), neighbour(2 * D), v_i,
                                                lanes_of<D>(neighbour, 0), options.least_distance);
            weight = neighbour(2 * D + 1);
        } else {
            v_ij = minus<D>(self.v, lanes_of<D>(neighbour, 0));
            for (std::size_t k = 0; k < kMatrix; ++k) B.e[k] = 0.5 * (B.e[k] + neighbour(D + k));
        }
        const Lanes F = weight * corrected_factor<D, Lanes>(pair, kernel.F(pair.r), B);
        // At a no-slip wall both forms are Morris's: the wall has a velocity, not only an approach.
        if constexpr (IsMorris || IsWall) {
            accumulate_morris<D, Lanes>(pair, F, v_ij, sums.a);
        } else {
            accumulate_monaghan_gingold<D, Lanes>(pair, F, v_ij, sums.a);
        }
    }

    HEADRACE_ALWAYS_INLINE void store(Index i, const Self&, const Sums& sums) const {
        const std::array<double, D> a = sum_lanes(sums.a);
        for (int k = 0; k < D; ++k) data.state.a_slow[k][i] += options.mu / data.particles.rho[i] * a[k];
    }
};

// ---- acoustic step: pressure of the walls; its centres are wall particles -------------------------------------------

struct WallPressureOptions {
    double p_min{};    // [Pa] walls do not pull below this; -infinity: they may
    double rho0_c2{};  // [Pa]
};

template <int D, class Kernel>
struct WallPressurePass {
    static constexpr bool kReadsWalls = false;
    static constexpr std::size_t kFluidFields = 2;  // p, rho
    static constexpr std::size_t kWallFields = 0;

    Kernel kernel;
    PassData data;
    WallPressureOptions options;

    struct Self {};
    struct Sums {
        Lanes W{}, p_W{};
        std::array<Lanes, D> rho_x_W{};
    };

    std::array<const double*, kFluidFields> fluid_fields() const {
        return {data.particles.p.data(), data.particles.rho.data()};
    }
    std::array<const double*, kWallFields> wall_fields() const { return {}; }
    HEADRACE_ALWAYS_INLINE Self load(Index) const { return {}; }

    template <bool IsWall, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self&, const Pair<D, Lanes>& pair, const Neighbour& neighbour,
                                     Sums& sums) const {
        const Lanes W = pair.V_j * kernel.W(pair.r);
        sums.W += W;
        sums.p_W += W * neighbour(0);
        add_to<D, Lanes>(sums.rho_x_W, scaled<D, Lanes>(W * neighbour(1), pair.x_ij));
    }

    HEADRACE_ALWAYS_INLINE void store(Index w, const Self&, const Sums& sums) const {
        const double W = sum_lanes(sums.W);
        double p = 0.0;
        if (W > 1e-12) {
            p = sum_lanes(sums.p_W);
            const std::array<double, D> rho_x_W = sum_lanes(sums.rho_x_W);
            for (int k = 0; k < D; ++k) p += data.wall_state.g[k][w] * rho_x_W[k];
            p = std::max(p / W, options.p_min);
        }
        data.wall_state.p[w] = p;
        data.wall_state.delta[w] = p / options.rho0_c2;
    }
};

}  // namespace headrace::solver
