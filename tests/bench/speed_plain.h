// The plain weakly compressible fluid whose run time is measured: continuity, pressure, artificial viscosity and
// density diffusion, fused into one loop, in a periodic cube (square) that a vortex stirs.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "server/solver/forces/artificial_viscosity.h"
#include "server/solver/forces/continuity.h"
#include "server/solver/forces/density_diffusion.h"
#include "server/solver/objects.h"
#include "server/solver/pair.h"
#include "server/solver/pairs/field_view.h"
#include "server/solver/particles.h"
#include "server/solver/smoothing_kernels.h"

namespace headrace::bench {

// In storage order. delta = rho/rho0 - 1. What is carried on from step to step is kept in double precision, what each
// step finds anew as the loops read it.
struct PlainFluid {
    int dimensions{3};
    double spacing{};      // [m]
    double support{};      // R [m]
    double sound_speed{};  // [m/s]
    double dt{};           // [s]
    solver::Domain domain;
    std::vector<solver::Index> id;
    solver::VectorField x, v_half;
    std::vector<double> delta_half;
    solver::NarrowField a;
    std::vector<float> V, delta_rate;  // [m^3] (2D: m^2), [1/s]

    std::size_t size() const { return id.size(); }
    // At the time of x, which needs no array; from the rates of before until compute() has found new ones.
    solver::FieldView v(int axis) const { return solver::FieldView::extrapolated(v_half[axis], 0.5 * dt, a[axis]); }
    solver::FieldView delta() const { return solver::FieldView::extrapolated(delta_half, 0.5 * dt, delta_rate); }
    double rho(solver::Index i) const {  // over rho0
        return 1.0 + delta_half[i] + 0.5 * dt * static_cast<double>(delta_rate[i]);
    }
};

// A lattice of edge^D points, jittered, in Taylor and Green's vortex (3D: Arnold, Beltrami and Childress's) at a Mach
// number of 0.1. Its mean pressure keeps it from tearing. waves: of the vortex along each edge.
PlainFluid make_plain_fluid(int dimensions, int edge, double support_over_dp, int waves = 1);

// The rates are known for the first time: starts v_half and delta_half.
void start_plain_fluid(PlainFluid& fluid);

// Kick and drift: v_half and delta_half to the middle of the step, x to its end.
void advance_plain_fluid(PlainFluid& fluid);

// Brings x back into the period.
void wrap_plain_fluid(PlainFluid& fluid);

// Puts all into the order that Order (ClusterOrder, CellGrid) found.
template <class Order>
void permute_plain_fluid(PlainFluid& fluid, const Order& order) {
    const auto permute = [&]<class T>(std::initializer_list<std::vector<T>*> fields) {
        std::vector<T> scratch;  // of one type at a time
        for (std::vector<T>* field : fields) order.permute(*field, scratch);
    };
    permute({&fluid.id});
    for (int k = 0; k < fluid.dimensions; ++k) {
        permute({&fluid.x[k], &fluid.v_half[k]});
        permute({&fluid.a[k]});
    }
    permute({&fluid.delta_half});
    permute({&fluid.V, &fluid.delta_rate});
}

// Its terms as a pass of the pair engine (pairs/pair_sums-inl.h).
template <int D>
struct PlainPass {
    static constexpr bool kReadsWalls = false, kIsOfWalls = false;
    static constexpr std::size_t kFluidFields = D + 1, kWallFields = 0;  // v, delta
    static constexpr std::size_t kFirstOwn = 0, kOwnFields = D + 1, kCentreFields = 0;
    static constexpr double kAlpha = 0.02;  // of the artificial viscosity

    explicit PlainPass(PlainFluid& of)
        : kernel(of.support),
          viscosity(kAlpha * 0.5 * of.support / of.sound_speed),
          diffusion(solver::kUsualDiffusion * 0.5 * of.support * of.sound_speed),
          fluid(of) {}

    solver::WendlandC2<D> kernel;
    double viscosity;  // alpha h / c0 [s]
    double diffusion;  // xi h c0 [m^2/s]
    PlainFluid& fluid;

    // Of half lists: times the volume of the point.
    template <class T>
    struct Sums {
        std::array<T, D> push{};
        T divergence{}, diffusion{};  // before their factors
    };
    template <class T>
    using Change = std::array<T, D + 1>;  // push, rate of delta

    std::array<const float*, 0> centre_fields() const { return {}; }
    std::array<solver::FieldView, kFluidFields> fluid_fields() const {
        std::array<solver::FieldView, kFluidFields> fields;
        for (int k = 0; k < D; ++k) fields[k] = fluid.v(k);
        fields[D] = fluid.delta();
        return fields;
    }

    template <bool IsWall, class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE void pair(const Self& self, const solver::Pair<D, T>& pair, const Neighbour& neighbour,
                                     Sums<T>& sums) const {
        add<T>(terms_of<T>(self, pair, pair.V_j * kernel.F(pair.r), neighbour), sums);
    }

    // Weighted by both volumes a pair's terms are the same for both points, but for signs.
    template <class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE Change<T> exchange(const Self& self, const solver::Pair<D, T>& pair, const T& V_i,
                                              const Neighbour& neighbour, Sums<T>& sums) const {
        const Sums<T> terms = terms_of<T>(self, pair, kernel.weighted_F(pair.r, V_i, pair.V_j), neighbour);
        add<T>(terms, sums);
        return change_of<T>(terms.push, diffusion * terms.diffusion + (1.0 + neighbour(D)) * terms.divergence);
    }

    template <class T, class Self>
    HEADRACE_ALWAYS_INLINE Change<T> gain(const Self& self, const Sums<T>& sums) const {
        return gain_of<T>(self(D), sums);
    }

    void store(solver::Index i, const Sums<double>& sums) const {
        store(i, gain_of<double>(fluid.rho(i) - 1.0, sums), 1.0);
    }
    void store(solver::Index i, const Change<double>& change) const {
        store(i, change, static_cast<double>(fluid.V[i]));
    }

  private:
    // V_F: V_j F, or V_i V_j F.
    template <class T, class Self, class Neighbour>
    HEADRACE_ALWAYS_INLINE Sums<T> terms_of(const Self& self, const solver::Pair<D, T>& pair, const T& V_F,
                                            const Neighbour& neighbour) const {
        std::array<T, D> v_ij;
        for (int k = 0; k < D; ++k) v_ij[k] = self(k) - neighbour(k);
        Sums<T> terms;
        terms.divergence = solver::velocity_divergence<D, T>(V_F, pair.x_ij, v_ij);
        terms.diffusion = solver::plain_diffusion<T>(V_F, self(D) - neighbour(D), T(0.0));
        // With the linear state equation p_i + p_j = rho0 c0^2 (delta_i + delta_j). Artificial viscosity adds to it:
        // one factor of x_ij for both, over rho0 c0^2.
        const T approach = solver::approach_rate<D, T>(pair, solver::dot<D, T>(v_ij, pair.x_ij));
        const T push = self(D) + neighbour(D) - viscosity * approach;
        terms.push = solver::scaled<D, T>(V_F * push, pair.x_ij);
        return terms;
    }

    template <class T>
    HEADRACE_ALWAYS_INLINE static void add(const Sums<T>& terms, Sums<T>& sums) {
        solver::add_to<D, T>(sums.push, terms.push);
        sums.divergence += terms.divergence;
        sums.diffusion += terms.diffusion;
    }

    template <class T>
    HEADRACE_ALWAYS_INLINE Change<T> gain_of(const T& delta, const Sums<T>& sums) const {
        return change_of<T>(sums.push, diffusion * sums.diffusion - (1.0 + delta) * sums.divergence);
    }

    template <class T>
    HEADRACE_ALWAYS_INLINE static Change<T> change_of(const std::array<T, D>& push, const T& rate) {
        Change<T> change;
        for (int k = 0; k < D; ++k) change[k] = push[k];
        change[D] = rate;
        return change;
    }

    // change: times `volume`
    void store(solver::Index i, const Change<double>& change, double volume) const {
        const double rho = fluid.rho(i), per_mass = 1.0 / (rho * volume);  // over rho0
        const double c2 = fluid.sound_speed * fluid.sound_speed;
        for (int k = 0; k < D; ++k) fluid.a[k][i] = static_cast<float>(-c2 * per_mass * change[k]);
        fluid.delta_rate[i] = static_cast<float>(rho * per_mass * change[D]);
    }
};

}  // namespace headrace::bench
