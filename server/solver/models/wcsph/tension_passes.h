// The passes of surface tension: once per advective step, on the positions that the step's force stands for. Both forms
// add to a_slow.
#pragma once

#include "server/solver/forces/continuum_surface_force.h"
#include "server/solver/forces/surface_tension.h"
#include "server/solver/models/wcsph/passes.h"

namespace headrace::solver {

struct TensionOptions {
    double sigma{};      // [N/m]
    FlatSurface flat;    // continuum form
    double threshold{};  // [1/m] thesis's form: colour gradient from which a particle is surface
};

// Stress S of the surface.
template <int D, class Kernel>
struct SurfaceStressPass {
    static constexpr bool kReadsWalls = true, kIsOfWalls = false;
    static constexpr std::size_t kFirstOwn = 0, kOwnFields = 0, kCentreFields = 0, kFluidFields = 0, kWallFields = 0;

    Kernel kernel;
    PassData data;
    TensionOptions options;

    template <class T>
    struct Sums {
        std::array<T, D> n{};
        T c{};
    };

    std::array<const float*, 0> centre_fields() const { return {}; }
    std::array<FieldView, 0> fluid_fields() const { return {}; }
    std::array<FieldView, 0> wall_fields() const { return {}; }
    template <bool IsWall, class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self&, const Pair<D, T>& pair, const Neighbour&, Sums<T>& sums) const {
        sums.c += pair.V_j * kernel.W(pair.r);
        add_to<D, T>(sums.n, scaled<D, T>(pair.V_j * kernel.F(pair.r), pair.x_ij));
    }

    void store(Index i, const Sums<double>& sums) const {
        write_matrix<D>(data.state.surface_stress, i, surface_stress<D>(sums.n, sums.c, options.flat.n));
    }
};

// Force of the stress. A wall mirrors it: the surface goes on into the wall, at right angles.
template <int D>
struct ContinuumTensionPass {
    static constexpr bool kReadsWalls = true, kIsOfWalls = false;
    static constexpr std::size_t kFirstOwn = 0, kOwnFields = 0, kCentreFields = 0, kFluidFields = symmetric_size(D),
                                 kWallFields = 0;

    TensionKernel<D> kernel;
    PassData data;
    TensionOptions options;

    template <class T>
    struct Sums {
        std::array<T, D> grad_1{}, S_grad{};
    };

    std::array<const float*, 0> centre_fields() const { return {}; }
    std::array<FieldView, kFluidFields> fluid_fields() const {
        std::array<FieldView, kFluidFields> fields;
        for (std::size_t k = 0; k < kFluidFields; ++k) fields[k] = data.state.surface_stress[k];
        return fields;
    }
    std::array<FieldView, 0> wall_fields() const { return {}; }
    template <bool IsWall, class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self&, const Pair<D, T>& pair, const Neighbour& neighbour,
                                     Sums<T>& sums) const {
        const std::array<T, D> grad = scaled<D, T>(pair.V_j * kernel.F(pair.r2), pair.x_ij);
        add_to<D, T>(sums.grad_1, IsWall ? scaled<D, T>(T(2.0), grad) : grad);
        if constexpr (!IsWall) {
            Symmetric<D, T> S_j;
            S_j.e = fields_of<T, symmetric_size(D)>(neighbour, 0);
            add_to<D, T>(sums.S_grad, S_j * grad);
        }
    }

    void store(Index i, const Sums<double>& sums) const {
        std::array<double, D> f = matrix_at<D>(data.state.surface_stress, i) * sums.grad_1;
        add_to<D, double>(f, sums.S_grad);
        const double factor = 2.0 * options.sigma / (options.flat.C * data.particles.rho[i]);
        for (int k = 0; k < D; ++k) data.state.a_slow[k][i] += factor * f[k];
    }
};

// The thesis's form, with the model's kernel in place of its poly6.
template <int D, class Kernel>
struct ThesisTensionPass {
    static constexpr bool kReadsWalls = true, kIsOfWalls = false;
    static constexpr std::size_t kFirstOwn = 0, kOwnFields = 0, kCentreFields = 0, kFluidFields = 0, kWallFields = 0;

    Kernel kernel;
    PassData data;
    TensionOptions options;

    template <class T>
    struct Sums {
        std::array<T, D> n{};
        T laplacian_c{};
    };

    std::array<const float*, 0> centre_fields() const { return {}; }
    std::array<FieldView, 0> fluid_fields() const { return {}; }
    std::array<FieldView, 0> wall_fields() const { return {}; }
    template <bool IsWall, class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self&, const Pair<D, T>& pair, const Neighbour&, Sums<T>& sums) const {
        const T F = kernel.F(pair.r);
        add_to<D, T>(sums.n, scaled<D, T>(pair.V_j * F, pair.x_ij));
        sums.laplacian_c += pair.V_j * (static_cast<double>(D) * F + pair.r * kernel.dF_dr(pair.r));
    }

    void store(Index i, const Sums<double>& sums) const {
        const std::array<double, D> n = sums.n;
        const double factor = tension_factor(options.sigma, sums.laplacian_c, dot<D, double>(n, n), options.threshold) /
                              data.particles.rho[i];
        for (int k = 0; k < D; ++k) data.state.a_slow[k][i] += factor * n[k];
    }
};

}  // namespace headrace::solver
