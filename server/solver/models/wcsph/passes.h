// The passes of the wcsph model: which fields a loop reads, which terms it sums, what it writes. Formulas are in
// forces/ and boundaries/; the loop is pairs/pair_sums-inl.h.
#pragma once

#include <algorithm>

#include "server/solver/boundaries/wall_state.h"
#include "server/solver/forces/artificial_viscosity.h"
#include "server/solver/forces/continuity.h"
#include "server/solver/forces/density_diffusion.h"
#include "server/solver/forces/gradient_correction.h"
#include "server/solver/forces/laminar_viscosity.h"
#include "server/solver/forces/pressure_gradient.h"
#include "server/solver/forces/separation.h"
#include "server/solver/forces/shifting.h"
#include "server/solver/models/wcsph/solid_share.h"
#include "server/solver/models/wcsph/state.h"
#include "server/solver/pair.h"
#include "server/solver/pairs/field_view.h"

namespace headrace::solver {

template <int D, class Field>
HEADRACE_ALWAYS_INLINE std::array<double, D> vector_at(const Field& field, std::size_t i) {
    std::array<double, D> u;
    for (int k = 0; k < D; ++k) u[k] = static_cast<double>(field[k][i]);
    return u;
}

// 0 where nothing is stored.
template <int D>
std::array<double, D> vector_or_zero(const VectorField& field, std::size_t i) {
    return field[0].empty() ? std::array<double, D>{} : vector_at<D>(field, i);
}

template <int D>
HEADRACE_ALWAYS_INLINE void write_vector(NarrowField& field, std::size_t i, const std::array<double, D>& u) {
    for (int k = 0; k < D; ++k) field[k][i] = static_cast<float>(u[k]);
}

template <int D>
HEADRACE_ALWAYS_INLINE Symmetric<D> matrix_at(const MatrixField& field, std::size_t i) {
    Symmetric<D> m;
    for (int k = 0; k < Symmetric<D>::kSize; ++k) m.e[k] = static_cast<double>(field[k][i]);
    return m;
}

template <int D>
HEADRACE_ALWAYS_INLINE void write_matrix(MatrixField& field, std::size_t i, const Symmetric<D>& m) {
    for (int k = 0; k < Symmetric<D>::kSize; ++k) field[k][i] = static_cast<float>(m.e[k]);
}

// p B [Pa]
template <int D>
HEADRACE_ALWAYS_INLINE Symmetric<D> pressure_matrix_at(const Particles& particles, const WcsphState& state,
                                                       std::size_t i) {
    Symmetric<D> pB = matrix_at<D>(state.B, i);
    for (double& component : pB.e) component *= particles.p[i];
    return pB;
}

// Fields first..first+N-1 of a point.
template <class T, int N, class Point>
HEADRACE_ALWAYS_INLINE std::array<T, N> fields_of(const Point& point, std::size_t first) {
    std::array<T, N> u;
    for (int k = 0; k < N; ++k) u[k] = point(first + static_cast<std::size_t>(k));
    return u;
}

template <int D, class T>
HEADRACE_ALWAYS_INLINE std::array<T, D> minus(const std::array<T, D>& a, const std::array<T, D>& b) {
    std::array<T, D> difference;
    for (int k = 0; k < D; ++k) difference[k] = a[k] - b[k];
    return difference;
}

// What all passes see.
struct PassData {
    Particles& particles;
    WcsphState& state;
    const WallParticles& walls;
    WallState& wall_state;
    SolidView solid{};  // walls without particles
};

// ---- once per advective step: moment matrix, surface, gradients, shift ----------------------------------------------

inline constexpr double kGradientEigenvalue = 0.3;  // from which a gradient is corrected

struct GeometryOptions {
    double spacing{};               // [m]
    double correction_threshold{};  // smallest eigenvalue that is corrected
    bool shifting{};
    bool reconstructs{};        // the strain rate is wanted
    double shift_factor{};      // C dt 2h [m s]
    double shift_speed{};       // [m/s] U of every particle, beside that of its strain rate
    double strain_length{};     // [m] U = strain_length |grad v|
    double W_dx{};              // W at one spacing
    double rho0_c2{1.0};        // [Pa] walls have the density of their pressure
    double dynamic_pressure{};  // rho0 U^2 [Pa]
    double noise{};             // [s] length of a random displacement added to the shift, over U
    std::uint64_t step{};       // drives its direction
    ShiftingLimits limits;
};

// HasGradients: velocity gradients, and what follows from them: the shift and the strain rate.
template <int D, class Kernel, bool HasGradients>
struct GeometryPass {
    static constexpr bool kReadsWalls = true, kIsOfWalls = false;
    static constexpr std::size_t kFluidFields = HasGradients ? 1 + D : 1;  // delta, v
    static constexpr std::size_t kFirstOwn = 0, kOwnFields = kFluidFields, kCentreFields = 0;
    static constexpr std::size_t kWallFields = HasGradients ? 2 + 2 * D : 1;  // delta, v, n, no_slip

    Kernel kernel;
    PassData data;
    GeometryOptions options;

    template <class T>
    struct Sums {
        Symmetric<D, T> M;
        std::array<T, D> grad_1{}, grad_delta{};
        std::array<T, D> shift{};
        std::array<std::array<T, D>, D> grad_v{};
    };

    std::array<const float*, 0> centre_fields() const { return {}; }
    std::array<FieldView, kFluidFields> fluid_fields() const {
        std::array<FieldView, kFluidFields> fields;
        fields[0] = data.state.delta;
        if constexpr (HasGradients) {
            for (int k = 0; k < D; ++k) fields[1 + k] = data.particles.v[k];
        }
        return fields;
    }
    std::array<FieldView, kWallFields> wall_fields() const {
        std::array<FieldView, kWallFields> fields;
        fields[0] = {1.0 / options.rho0_c2, data.wall_state.p};
        if constexpr (HasGradients) {
            for (int k = 0; k < D; ++k) {
                fields[1 + k] = view_or_zero(data.walls.v[k]);
                fields[1 + D + k] = data.walls.n[k];
            }
            fields[1 + 2 * D] = view_or_zero(data.wall_state.no_slip);
        }
        return fields;
    }

    template <bool IsWall, class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const Pair<D, T>& pair, const Neighbour& neighbour,
                                     Sums<T>& sums) const {
        const T F = kernel.F(pair.r);
        accumulate_moment<D, T>(pair, F, sums.M);
        const std::array<T, D> grad = scaled<D, T>(pair.V_j * F, pair.x_ij);
        add_to<D, T>(sums.grad_1, grad);
        add_to<D, T>(sums.grad_delta, scaled<D, T>(neighbour(0) - self(0), grad));
        if constexpr (HasGradients) {
            const T W = kernel.W(pair.r) * (1.0 / options.W_dx);
            add_to<D, T>(sums.shift, scaled<D, T>(shifting_factor<D, T>(pair, F, W), pair.x_ij));
            std::array<T, D> v_ij = minus<D, T>(fields_of<T, D>(self, 1), fields_of<T, D>(neighbour, 1));
            if constexpr (IsWall) {
                // A slippery wall says nothing about the tangential velocity.
                const std::array<T, D> n = fields_of<T, D>(neighbour, 1 + D);
                const T slides = 1.0 - neighbour(1 + 2 * D), normal = dot<D, T>(v_ij, n);
                for (int k = 0; k < D; ++k) v_ij[k] += slides * (normal * n[k] - v_ij[k]);
            }
            for (int k = 0; k < D; ++k) {
                for (int l = 0; l < D; ++l) sums.grad_v[k][l] -= v_ij[k] * grad[l];
            }
        }
    }

    // Row k: the corrected gradient of v_k [1/s]; 0 where too little is around to tell.
    static std::array<std::array<double, D>, D> velocity_gradient(const Sums<double>& sums, const Symmetric<D>& L,
                                                                  double eigenvalue) {
        std::array<std::array<double, D>, D> grad_v{};
        if (eigenvalue < kGradientEigenvalue) return grad_v;
        for (int k = 0; k < D; ++k) grad_v[k] = L * sums.grad_v[k];
        return grad_v;
    }

    void store(Index i, const Sums<double>& of_pairs) const {
        WcsphState& state = data.state;
        Sums<double> sums = of_pairs;
        if (data.solid.is_near(vector_at<D>(data.particles.x, i))) {
            add_solid_geometry<D>(
                data.solid, data.particles, state.delta[i], i,
                {sums.M, sums.grad_1, sums.grad_delta, sums.shift, HasGradients ? &sums.grad_v : nullptr});
        }
        const Symmetric<D>& M = sums.M;
        const double eigenvalue = smallest_eigenvalue(M);
        const Symmetric<D> B = correction_matrix<D>(M, eigenvalue, options.correction_threshold);
        const std::array<double, D>& normal = sums.grad_1;
        // Gradients may be corrected far nearer to a free surface than forces.
        const Symmetric<D> L = correction_matrix<D>(M, eigenvalue, kGradientEigenvalue);
        const std::array<double, D> grad_delta = L * sums.grad_delta;
        state.min_eigenvalue[i] = static_cast<float>(eigenvalue);
        write_matrix<D>(state.B, i, B);
        state.unevenness[i] = static_cast<float>(options.spacing * std::sqrt(dot<D, double>(normal, normal)));
        write_vector<D>(state.grad_delta, i, grad_delta);
        if constexpr (HasGradients) {
            const auto grad_v = velocity_gradient(sums, L, eigenvalue);
            double grad2 = 0.0;
            for (const auto& row : grad_v) grad2 += dot<D, double>(row, row);
            const double U = (options.shift_speed + options.strain_length * std::sqrt(grad2)) *
                             shifting_need(options.dynamic_pressure, data.particles.p[i]);
            std::array<double, D> dx = sums.shift;
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
            state.ddelta[i] = static_cast<float>(dot<D, double>(grad_delta, dx));
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
    static constexpr bool kReadsWalls = true, kIsOfWalls = false;
    static constexpr std::size_t kFluidFields = D + (kIsDiffusive ? 1 : 0) + (kIsAntuono ? D : 0);
    static constexpr std::size_t kWallFields = D;
    static constexpr std::size_t kFirstOwn = 0, kOwnFields = kFluidFields;
    static constexpr std::size_t kCentreFields = symmetric_size(D);  // B

    Kernel kernel;
    PassData data;
    ContinuityOptions options;

    template <class T>
    struct Sums {
        T divergence{}, diffusion{};
    };

    std::array<const float*, kCentreFields> centre_fields() const {
        std::array<const float*, kCentreFields> fields;
        for (std::size_t k = 0; k < kCentreFields; ++k) fields[k] = data.state.B[k].data();
        return fields;
    }
    std::array<FieldView, kFluidFields> fluid_fields() const {
        std::array<FieldView, kFluidFields> fields;
        for (int k = 0; k < D; ++k) {
            fields[k] = data.particles.v[k];
            if constexpr (kIsAntuono) fields[D + 1 + k] = data.state.grad_delta[k];
        }
        if constexpr (kIsDiffusive) fields[D] = data.state.delta;
        return fields;
    }
    std::array<FieldView, kWallFields> wall_fields() const {
        std::array<FieldView, kWallFields> fields;
        for (int k = 0; k < D; ++k) fields[k] = view_or_zero(data.walls.v[k]);
        return fields;
    }

    template <bool IsWall, class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const Pair<D, T>& pair, const Neighbour& neighbour,
                                     Sums<T>& sums) const {
        const T V_F = pair.V_j * kernel.F(pair.r);
        const std::array<T, D> v_ij = minus<D, T>(fields_of<T, D>(self, 0), fields_of<T, D>(neighbour, 0));
        Symmetric<D, T> B;
        B.e = fields_of<T, symmetric_size(D)>(self, kFluidFields);
        sums.divergence += velocity_divergence<D, T>(V_F, B * pair.x_ij, v_ij);
        if constexpr (kIsDiffusive && !IsWall) {
            const T delta_ij = self(D) - neighbour(D);
            if constexpr (kIsAntuono) {
                std::array<T, D> sum_grad = fields_of<T, D>(self, D + 1);
                add_to<D, T>(sum_grad, fields_of<T, D>(neighbour, D + 1));
                sums.diffusion += antuono_diffusion<D, T>(V_F, pair.x_ij, delta_ij, sum_grad);
            } else {
                T delta_H(0.0);
                for (int k = 0; k < D; ++k) delta_H += options.g_over_c2[k] * pair.x_ij[k];
                sums.diffusion += plain_diffusion<T>(V_F, delta_ij, delta_H);
            }
        }
    }

    void store(Index i, const Sums<double>& sums) const {
        double divergence = sums.divergence;
        if (data.solid.is_near(vector_at<D>(data.particles.x, i)))
            divergence += solid_divergence<D>(data.solid, data.particles, matrix_at<D>(data.state.B, i), i);
        double rate = -(1.0 + data.state.delta[i]) * divergence;
        if constexpr (kIsDiffusive) rate += options.diffusion * sums.diffusion;
        data.state.delta_rate[i] = rate;
    }
};

// ---- acoustic step: momentum ----------------------------------------------------------------------------------------

struct PressureOptions {
    double artificial_viscosity{};  // alpha h c0 rho0 [Pa s]
    bool controls_tension{};
    TensionLimits tension_limits;
    bool walls_suck{};  // may their pressure be negative?
    Vec3 gravity{};     // [m/s^2] where no slow acceleration is stored
};

template <int D, class Kernel, bool IsAdjoint, bool HasAlpha>
struct PressurePass {
    static constexpr bool kReadsWalls = true, kIsOfWalls = false;
    static constexpr std::size_t kPressureFields = IsAdjoint ? symmetric_size(D) : 1;
    static constexpr std::size_t kFluidFields = kPressureFields + (HasAlpha ? D + symmetric_size(D) : 0);
    static constexpr std::size_t kWallFields = 1;
    static constexpr std::size_t kFirstOwn = kPressureFields,
                                 kOwnFields = kFluidFields - kPressureFields;  // v, strain/2
    static constexpr std::size_t kCentreFields = 0;

    Kernel kernel;
    PassData data;
    PressureOptions options;

    template <class T>
    struct Sums {
        PressureSums<D, T> fluid, walls;
        // Of the artificial viscosity. In the adjoint form it acts like a pressure -alpha h c0 rho0 pi_ij of the
        // neighbour and is summed with it.
        std::array<T, IsAdjoint ? 1 : D> artificial{};
    };

    std::array<const float*, 0> centre_fields() const { return {}; }
    std::array<FieldView, kFluidFields> fluid_fields() const {
        std::array<FieldView, kFluidFields> fields;
        if constexpr (IsAdjoint) {
            for (std::size_t k = 0; k < kPressureFields; ++k) fields[k] = {data.particles.p, data.state.B[k]};
        } else {
            fields[0] = data.particles.p;
        }
        if constexpr (HasAlpha) {
            for (int k = 0; k < D; ++k) fields[kPressureFields + k] = data.particles.v[k];
            for (int k = 0; k < symmetric_size(D); ++k) fields[kPressureFields + D + k] = {0.5, data.state.strain[k]};
        }
        return fields;
    }
    std::array<FieldView, kWallFields> wall_fields() const { return {data.wall_state.p}; }

    template <bool IsWall, class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const Pair<D, T>& pair, const Neighbour& neighbour,
                                     Sums<T>& sums) const {
        const T V_F = pair.V_j * kernel.F(pair.r);
        if constexpr (IsWall) {
            accumulate_difference<D, T>(V_F, pair.x_ij, neighbour(0), sums.walls);
        } else {
            T rate(0.0);
            if constexpr (HasAlpha) {
                const std::array<T, D> v_ij =
                    minus<D, T>(fields_of<T, D>(self, 0), fields_of<T, D>(neighbour, kPressureFields));
                Symmetric<D, T> mean_strain;
                for (int k = 0; k < symmetric_size(D); ++k)
                    mean_strain.e[k] = self(D + k) + neighbour(kPressureFields + D + k);
                rate = approach_rate<D, T>(pair, v_ij, mean_strain);
            }
            if constexpr (IsAdjoint) {
                Symmetric<D, T> pB_j;
                pB_j.e = fields_of<T, symmetric_size(D)>(neighbour, 0);
                if constexpr (HasAlpha) {
                    const T damping = options.artificial_viscosity * rate;
                    for (int k = 0; k < D; ++k) pB_j(k, k) -= damping;
                }
                accumulate_adjoint<D, T>(V_F, pair.x_ij, pB_j, sums.fluid);
            } else {
                accumulate_difference<D, T>(V_F, pair.x_ij, neighbour(0), sums.fluid);
                if constexpr (HasAlpha) add_to<D, T>(sums.artificial, scaled<D, T>(V_F * rate, pair.x_ij));
            }
        }
    }

    void store(Index i, const Sums<double>& sums) const {
        const double p = data.particles.p[i], rho = data.particles.rho[i];
        PressureSums<D, double> total = sums.fluid, walls = sums.walls;
        const Symmetric<D> B = matrix_at<D>(data.state.B, i);
        const bool is_controlled =
            IsAdjoint && options.controls_tension &&
            controls_tension(p, static_cast<double>(data.state.min_eigenvalue[i]),
                             static_cast<double>(data.state.unevenness[i]), options.tension_limits);
        const double sign = is_controlled ? -1.0 : 1.0;
        const auto pB = [&] { return pressure_matrix_at<D>(data.particles, data.state, i); };
        if (data.solid.is_near(vector_at<D>(data.particles.x, i))) {
            const std::array<double, D> own =
                IsAdjoint ? own_pressure<D>(sums.fluid, pB(), sign) : own_pressure<D>(sums.fluid, p);
            add_solid_pressure<D>(data.solid, data.particles, i, sums.fluid, own, walls);
        }
        // Where walls do not suck, controlled tension would push the particle off the wall, the more the further it
        // goes: it ends at the fluid.
        if (!is_controlled || options.walls_suck) add_to<D, double>(total.grad_1, walls.grad_1);
        // A wall particle has B = 1: with the fluid particle's, walls would feed energy into still water.
        add_to<D, double>(total.pB_grad, walls.pB_grad);
        std::array<double, D> a;
        if constexpr (IsAdjoint) {
            a = adjoint_acceleration<D>(total, pB(), sign, rho);
        } else {
            a = difference_acceleration<D>(total, p, B, rho);
        }
        if constexpr (HasAlpha && !IsAdjoint) {
            for (int k = 0; k < D; ++k) a[k] += options.artificial_viscosity / rho * sums.artificial[k];
        }
        const VectorField& a_slow = data.state.a_slow;
        for (int k = 0; k < D; ++k)
            data.particles.a[k][i] = a[k] + (a_slow[k].empty() ? options.gravity[k] : a_slow[k][i]);
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
    static constexpr bool kReadsWalls = true, kIsOfWalls = false;
    static constexpr std::size_t kMatrix = symmetric_size(D);
    static constexpr std::size_t kFluidFields = D + kMatrix;  // v, B
    static constexpr std::size_t kFirstOwn = 0, kOwnFields = kFluidFields, kCentreFields = 0;
    static constexpr std::size_t kWallFields = 2 * D + 2;  // v, n, depth, no_slip

    Kernel kernel;
    PassData data;
    ViscosityOptions options;

    template <class T>
    struct Sums {
        std::array<T, D> a{};
    };

    std::array<const float*, 0> centre_fields() const { return {}; }
    std::array<FieldView, kFluidFields> fluid_fields() const {
        std::array<FieldView, kFluidFields> fields;
        for (int k = 0; k < D; ++k) fields[k] = data.particles.v[k];
        for (std::size_t k = 0; k < kMatrix; ++k) fields[D + k] = data.state.B[k];
        return fields;
    }
    std::array<FieldView, kWallFields> wall_fields() const {
        std::array<FieldView, kWallFields> fields;
        for (int k = 0; k < D; ++k) {
            fields[k] = view_or_zero(data.walls.v[k]);
            fields[D + k] = data.walls.n[k];
        }
        fields[2 * D] = data.walls.depth;
        fields[2 * D + 1] = view_or_zero(data.wall_state.no_slip);
        return fields;
    }

    template <bool IsWall, class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const Pair<D, T>& pair, const Neighbour& neighbour,
                                     Sums<T>& sums) const {
        Symmetric<D, T> B;
        B.e = fields_of<T, symmetric_size(D)>(self, D);
        const std::array<T, D> v_i = fields_of<T, D>(self, 0), v_j = fields_of<T, D>(neighbour, 0);
        std::array<T, D> v_ij;
        T weight(1.0);
        if constexpr (IsWall) {
            v_ij = no_slip_difference<D, T>(pair, fields_of<T, D>(neighbour, D), neighbour(2 * D), v_i, v_j,
                                            options.least_distance);
            weight = neighbour(2 * D + 1);
        } else {
            v_ij = minus<D, T>(v_i, v_j);
            for (std::size_t k = 0; k < kMatrix; ++k) B.e[k] = 0.5 * (B.e[k] + neighbour(D + k));
        }
        const T F = weight * corrected_factor<D, T>(pair, kernel.F(pair.r), B);
        // At a no-slip wall both forms are Morris's: the wall has a velocity, not only an approach.
        if constexpr (IsMorris || IsWall) {
            accumulate_morris<D, T>(pair, F, v_ij, sums.a);
        } else {
            accumulate_monaghan_gingold<D, T>(pair, F, v_ij, sums.a);
        }
    }

    void store(Index i, const Sums<double>& sums) const {
        std::array<double, D> a = sums.a;
        if (data.solid.is_near(vector_at<D>(data.particles.x, i))) {
            add_solid_viscosity<D>(data.solid, data.particles, matrix_at<D>(data.state.B, i), options.least_distance, i,
                                   a);
        }
        for (int k = 0; k < D; ++k) data.state.a_slow[k][i] += options.mu / data.particles.rho[i] * a[k];
    }
};

// ---- acoustic step: pressure of the walls; its centres are wall particles -------------------------------------------

struct WallPressureOptions {
    double p_min{};  // [Pa] walls do not pull below this; -infinity: they may
    Vec3 gravity{};  // [m/s^2] where no other is stored
};

template <int D, class Kernel>
struct WallPressurePass {
    static constexpr bool kReadsWalls = false, kIsOfWalls = true;
    static constexpr std::size_t kFluidFields = 2;  // p, rho
    static constexpr std::size_t kWallFields = 0, kFirstOwn = 0, kOwnFields = 0, kCentreFields = 0;

    Kernel kernel;
    PassData data;
    WallPressureOptions options;

    template <class T>
    struct Sums {
        T W{}, p_W{};
        std::array<T, D> rho_x_W{};
    };

    std::array<const float*, 0> centre_fields() const { return {}; }
    std::array<FieldView, kFluidFields> fluid_fields() const { return {data.particles.p, data.particles.rho}; }
    std::array<FieldView, kWallFields> wall_fields() const { return {}; }
    template <bool IsWall, class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self&, const Pair<D, T>& pair, const Neighbour& neighbour,
                                     Sums<T>& sums) const {
        const T W = pair.V_j * kernel.W(pair.r);
        sums.W += W;
        sums.p_W += W * neighbour(0);
        add_to<D, T>(sums.rho_x_W, scaled<D, T>(W * neighbour(1), pair.x_ij));
    }

    void store(Index w, const Sums<double>& sums) const {
        double p = 0.0;
        if (sums.W > 1e-12) {
            p = sums.p_W;
            const VectorField& g = data.wall_state.g;
            for (int k = 0; k < D; ++k) p += (g[k].empty() ? options.gravity[k] : g[k][w]) * sums.rho_x_W[k];
            p = std::max(p / sums.W, options.p_min);
        }
        data.wall_state.p[w] = static_cast<float>(p);
    }
};

}  // namespace headrace::solver
