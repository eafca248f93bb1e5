// What walls without particles (boundaries/integral_walls.h) add to the sums of the passes. With the solid S of a
// wall within the support of particle i, y = x' - x_i, everything that a dummy would be asked for is taken to be
//
//   pressure   p_i + s . y, the slope s across the wall that of still fluid, h = rho_i (g - a_wall), along it the
//   fluid's velocity   the wall's; slippery and sticky as with dummies (passes.h)
//
// and the integrals of it over S are sums over the wall's parts. The fluid's slope comes from the same pass: with
// D = sum over fluid of V_j (p_j - p_i) grad W and M = integral of y (x) grad W, the sum over fluid and solid is the
// gradient f that both have in common,
//
//   f = D + (M - sum_a m_a n_a n_a) f + sum_a m_a n_a (n_a . h),   m_a = n_a . M_a n_a of the part a
//
// so that a flat wall adds m (n . h) across, and along it the fluid's part stands for the whole: D_t/(1 - m_t).
// Still fluid's slope in all directions would hold up what falls freely along a wall; dummies take the fluid's mean.
//
// Along all walls near, D is taken as the pass itself sums it, with the particle's own pressure in its form: the solid
// continues the fluid, its free surface included, which the wall then disturbs no more than fluid would.
#pragma once

#include <vector>

#include "server/solver/forces/pressure_gradient.h"
#include "server/solver/particles.h"

namespace headrace::solver {

class IntegralWalls;

// The walls' part in the sums of the pressure pass, object by object: for who asks for forces on objects. Arrays are in
// the particles' order.
struct SolidSums {
    struct OfObject {
        VectorField grad_1;   // [1/m]
        VectorField pB_grad;  // [Pa/m]
    };
    std::vector<OfObject> objects;
};

// As the passes see them.
struct SolidView {
    const IntegralWalls* walls{};    // null: none
    Vec3 gravity{};                  // [m/s^2]
    const VectorField* a_body{};     // [m/s^2] gravity and body force on each particle; null: gravity alone
    double inv_c2{};                 // [s^2/m^2]
    bool walls_suck{};               // may their pressure be negative?
    SolidSums* record{};             // null: nobody asks
    Vec3 inner_low{}, inner_high{};  // [m] between them only obstacles are near
    bool has_obstacles{};

    template <std::size_t N>
    HEADRACE_ALWAYS_INLINE bool is_near(const std::array<double, N>& x) const {
        if (walls == nullptr) return false;
        for (std::size_t k = 0; k < N; ++k) {
            if (x[k] < inner_low[k] || x[k] > inner_high[k]) return true;
        }
        return has_obstacles && is_near_obstacle(x);
    }
    bool is_near_obstacle(const std::array<double, 2>& x) const;
    bool is_near_obstacle(const std::array<double, 3>& x) const;

    template <int D>
    std::array<double, D> gravity_on(Index i) const {
        std::array<double, D> g;
        for (int k = 0; k < D; ++k) g[k] = a_body ? (*a_body)[k][i] : gravity[k];
        return g;
    }
};

// What the passes add for particle i, near a wall.

// Moment matrix, gradients of 1, delta and v (row k of grad_v: that of v_k; null: not wanted), shift.
template <int D>
struct GeometryShares {
    Symmetric<D>& M;
    std::array<double, D>&grad_1, &grad_delta, &shift;
    std::array<std::array<double, D>, D>* grad_v{};
};
template <int D>
void add_solid_geometry(const SolidView& solid, const Particles& particles, double delta, Index i,
                        GeometryShares<D> sums);

// Divergence of the velocity, corrected by B.
template <int D>
double solid_divergence(const SolidView& solid, const Particles& particles, const Symmetric<D>& B, Index i);

// fluid: sums over the fluid; own: what the particle's pressure makes of its grad_1 in the pass's form, own_pressure();
// walls: gets the solid's sums.
template <int D>
void add_solid_pressure(const SolidView& solid, const Particles& particles, Index i,
                        const PressureSums<D, double>& fluid, const std::array<double, D>& own,
                        PressureSums<D, double>& walls);

// pB_i: adjoint form, sign as in adjoint_acceleration(); p_i: difference form.
template <int D>
std::array<double, D> own_pressure(const PressureSums<D, double>& fluid, const Symmetric<D>& pB_i, double sign) {
    return scaled<D, double>(sign, pB_i * fluid.grad_1);
}
template <int D>
std::array<double, D> own_pressure(const PressureSums<D, double>& fluid, double p_i) {
    return scaled<D, double>(-p_i, fluid.grad_1);
}

// No-slip viscosity, to be multiplied by mu/rho_i (forces/laminar_viscosity.h, Morris's form).
template <int D>
void add_solid_viscosity(const SolidView& solid, const Particles& particles, const Symmetric<D>& B,
                         double least_distance, Index i, std::array<double, D>& sum);

}  // namespace headrace::solver
