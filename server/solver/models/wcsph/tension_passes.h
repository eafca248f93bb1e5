// The passes of surface tension: once per advective step, on the positions of its middle. Both forms add to a_slow.
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

// Direction q of the surface.
template <int D, class Kernel>
struct SurfaceDirectionPass {
    static constexpr bool kReadsWalls = true;
    static constexpr std::size_t kFluidFields = 0, kWallFields = 0;

    Kernel kernel;
    PassData data;
    TensionOptions options;

    struct Self {};
    struct Sums {
        std::array<Lanes, D> n{};
    };

    std::array<const double*, 0> fluid_fields() const { return {}; }
    std::array<const double*, 0> wall_fields() const { return {}; }
    HEADRACE_ALWAYS_INLINE Self load(Index) const { return {}; }

    template <bool IsWall, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self&, const Pair<D, Lanes>& pair, const Neighbour&, Sums& sums) const {
        add_to<D, Lanes>(sums.n, scaled<D, Lanes>(pair.V_j * kernel.F(pair.r), pair.x_ij));
    }

    HEADRACE_ALWAYS_INLINE void store(Index i, const Self&, const Sums& sums) const {
        write_vector<D>(data.state.surface_direction, i, surface_direction<D>(sum_lanes(sums.n), options.flat.n));
    }
};

// Force of the directions' differences; walls have none.
template <int D, class Kernel>
struct ContinuumTensionPass {
    static constexpr bool kReadsWalls = true;
    static constexpr std::size_t kFluidFields = D, kWallFields = 0;

    Kernel kernel;
    PassData data;
    TensionOptions options;

    struct Self {
        std::array<double, D> q;
    };
    struct Sums {
        std::array<Lanes, D> f{};
    };

    std::array<const double*, kFluidFields> fluid_fields() const {
        std::array<const double*, kFluidFields> fields;
        for (int k = 0; k < D; ++k) fields[k] = data.state.surface_direction[k].data();
        return fields;
    }
    std::array<const double*, 0> wall_fields() const { return {}; }
    HEADRACE_ALWAYS_INLINE Self load(Index i) const { return {vector_at<D>(data.state.surface_direction, i)}; }

    template <bool IsWall, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const Pair<D, Lanes>& pair, const Neighbour& neighbour,
                                     Sums& sums) const {
        std::array<Lanes, D> q_ij;
        if constexpr (IsWall) {
            for (int k = 0; k < D; ++k) q_ij[k] = splat<Lanes>(self.q[k]);
        } else {
            q_ij = minus<D>(self.q, lanes_of<D>(neighbour, 0));
        }
        accumulate_hessian<D, Lanes>(pair, kernel.F(pair.r), kernel.dF_dr(pair.r), q_ij, sums.f);
    }

    HEADRACE_ALWAYS_INLINE void store(Index i, const Self&, const Sums& sums) const {
        const std::array<double, D> f = sum_lanes(sums.f);
        const double factor = -2.0 * options.sigma / (options.flat.C * data.particles.rho[i]);
        for (int k = 0; k < D; ++k) data.state.a_slow[k][i] += factor * f[k];
    }
};

// The thesis's form, with the model's kernel in place of its poly6.
template <int D, class Kernel>
struct ThesisTensionPass {
    static constexpr bool kReadsWalls = true;
    static constexpr std::size_t kFluidFields = 0, kWallFields = 0;

    Kernel kernel;
    PassData data;
    TensionOptions options;

    struct Self {};
    struct Sums {
        std::array<Lanes, D> n{};
        Lanes laplacian_c{};
    };

    std::array<const double*, 0> fluid_fields() const { return {}; }
    std::array<const double*, 0> wall_fields() const { return {}; }
    HEADRACE_ALWAYS_INLINE Self load(Index) const { return {}; }

    template <bool IsWall, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self&, const Pair<D, Lanes>& pair, const Neighbour&, Sums& sums) const {
        const Lanes F = kernel.F(pair.r);
        add_to<D, Lanes>(sums.n, scaled<D, Lanes>(pair.V_j * F, pair.x_ij));
        sums.laplacian_c += pair.V_j * (static_cast<double>(D) * F + pair.r * kernel.dF_dr(pair.r));
    }

    HEADRACE_ALWAYS_INLINE void store(Index i, const Self&, const Sums& sums) const {
        const std::array<double, D> n = sum_lanes(sums.n);
        const double factor =
            tension_factor(options.sigma, sum_lanes(sums.laplacian_c), dot<D, double>(n, n), options.threshold) /
            data.particles.rho[i];
        for (int k = 0; k < D; ++k) data.state.a_slow[k][i] += factor * n[k];
    }
};

}  // namespace headrace::solver
