#include "server/solver/models/wcsph/solid_share.h"

#include <algorithm>
#include <cmath>

#include "server/solver/models/wcsph/solid_parts.h"

namespace headrace::solver {
namespace {

template <int D>
std::array<double, D> at(const VectorField& field, Index i) {
    std::array<double, D> u;
    for (int k = 0; k < D; ++k) u[k] = field[k][i];
    return u;
}

// What a wall's pressure adds, by parts: sum over them of integrals of p grad W.
template <int D>
struct SolidPressure {
    std::array<double, D> sum{};
    std::array<std::array<double, D>, WallShare<D>::kMost> of_part;  // only if wanted
};

// p, slope, of_fluid: p_i, h and D of the header, or any of the same law.
template <int D>
void find_pressure(const WallShare<D>& share, double p, const std::array<double, D>& slope,
                   const std::array<double, D>& of_fluid, bool walls_suck, bool by_parts, SolidPressure<D>& result) {
    constexpr double kLeast = 1e-3;  // in gaps far narrower than the support the fluid tells nothing
    std::array<double, D> right = of_fluid, across{}, sum{}, shared = share.grad;
    Symmetric<D> left;
    for (int k = 0; k < Symmetric<D>::kSize; ++k) left.e[k] = -share.M[k];
    for (int k = 0; k < D; ++k) left(k, k) += 1.0;
    const double p_shared = walls_suck ? p : std::max(p, 0.0);
    double weights = 0.0;
    for (int a = 0; a < share.count; ++a) {
        const WallPart<D>& part = share.part[a];
        const double h = dot<D, double>(part.n, slope), m = part.m_n;
        // What pushes the fluid off the wall; a wall that does not pull ends at 0.
        const double push = -p * dot<D, double>(part.grad_n, part.n) - m * h;
        const double lost = walls_suck ? 0.0 : std::min(push, 0.0);
        for (int k = 0; k < D; ++k) {
            right[k] += m * h * part.n[k];
            across[k] += m * h * part.n[k];
            for (int l = k; l < D; ++l) left(k, l) += m * part.n[k] * part.n[l];
            sum[k] += p * part.grad_n[k] + lost * part.n[k];
            shared[k] -= part.grad_n[k];
        }
        if (!by_parts) continue;
        weights += std::sqrt(dot<D, double>(part.grad, part.grad));
        for (int k = 0; k < D; ++k) {
            result.of_part[a][k] =
                p * part.grad_n[k] + (lost + m * h) * part.n[k] + p_shared * (part.grad[k] - part.grad_n[k]);
        }
    }
    const std::array<double, D> gradient = determinant(left) > kLeast ? inverse(left) * right : right;
    for (int k = 0; k < D; ++k) result.sum[k] = sum[k] + gradient[k] - of_fluid[k] + p_shared * shared[k];
    if (!by_parts) return;
    // Along the walls, by the parts' weight.
    for (int a = 0; a < share.count; ++a) {
        const std::array<double, D>& grad = share.part[a].grad;
        const double weight = weights > 0.0 ? std::sqrt(dot<D, double>(grad, grad)) / weights : 1.0 / share.count;
        for (int k = 0; k < D; ++k) result.of_part[a][k] += weight * (gradient[k] - of_fluid[k] - across[k]);
    }
}

template <int D>
void add_velocities(const WallShare<D>& share, const std::array<double, D>& v,
                    std::array<std::array<double, D>, D>& grad_v) {
    for (int a = 0; a < share.count; ++a) {
        const WallPart<D>& part = share.part[a];
        std::array<double, D> past = velocity_past<D>(part, v);
        const bool no_slip = part.surface->no_slip;
        // A slippery wall says nothing about the tangential velocity.
        if (!no_slip) past = scaled<D, double>(dot<D, double>(past, part.n), part.n);
        const std::array<double, D>& grad = no_slip ? part.grad : part.grad_n;
        for (int k = 0; k < D; ++k) {
            for (int l = 0; l < D; ++l) grad_v[k][l] -= past[k] * grad[l];
        }
    }
}

// ---- the same for a lonely face of the room -------------------------------------------------------------------------

// Integral of p grad W: along the face the fluid's sum, times what the solid has of the support over what it has not.
template <int D>
std::array<double, D> find_pressure(const LonelyFace& face, const WallProfile& profile, double p,
                                    const std::array<double, D>& slope, const std::array<double, D>& of_fluid,
                                    bool walls_suck) {
    const double along = profile.m_t / (1.0 - profile.m_t);
    std::array<double, D> sum = scaled<D, double>(along, of_fluid);
    const double push = p * profile.w - profile.m_n * face.sign * slope[face.axis];
    sum[face.axis] = -face.sign * (walls_suck ? push : std::max(push, 0.0));
    return sum;
}

template <int D>
std::array<double, D> velocity_past(const LonelyFace& face, const std::array<double, D>& v) {
    std::array<double, D> past;
    for (int k = 0; k < D; ++k) past[k] = v[k] - (k == face.axis ? 0.0 : face.surface->v[k]);
    return past;
}

template <int D>
void add_geometry(const LonelyFace& face, const WallProfile& profile, const std::array<double, D>& v, double delta,
                  const std::array<double, D>& slope, bool walls_suck, GeometryShares<D> sums) {
    const int n = face.axis;
    const double grad = -face.sign * profile.w;
    const std::array<double, D> of_delta = find_pressure<D>(face, profile, delta, slope, sums.grad_delta, walls_suck);
    add_to<D, double>(sums.grad_delta, of_delta);
    sums.grad_delta[n] -= delta * grad;
    for (int k = 0; k < D; ++k) sums.M(k, k) += k == n ? profile.m_n : profile.m_t;
    sums.grad_1[n] += grad;
    sums.shift[n] -= face.sign * profile.w_shifted;
    if (!sums.grad_v) return;
    const std::array<double, D> past = velocity_past<D>(face, v);
    for (int k = 0; k < D; ++k) {
        if (k == n || face.surface->no_slip) (*sums.grad_v)[k][n] -= past[k] * grad;
    }
}

}  // namespace

bool SolidView::is_near_obstacle(const std::array<double, 2>& x) const {
    return walls->is_near_obstacle<2>(x);
}
bool SolidView::is_near_obstacle(const std::array<double, 3>& x) const {
    return walls->is_near_obstacle<3>(x);
}

template <int D>
void add_solid_geometry(const SolidView& solid, const Particles& particles, double delta, Index i,
                        GeometryShares<D> sums) {
    const std::array<double, D> slope = scaled<D, double>((1.0 + delta) * solid.inv_c2, solid.gravity_on<D>(i));
    LonelyFace face;
    if (solid.walls->find_lonely_face<D>(at<D>(particles.x, i), face)) {
        add_geometry<D>(face, solid.walls->profile(face.distance), at<D>(particles.v, i), delta, slope,
                        solid.walls_suck, sums);
        return;
    }
    WallShare<D> share;
    solid.walls->find_share<D>(at<D>(particles.x, i), -1.0, share);
    SolidPressure<D> of_delta;
    find_pressure<D>(share, delta, slope, sums.grad_delta, solid.walls_suck, false, of_delta);
    for (int k = 0; k < Symmetric<D>::kSize; ++k) sums.M.e[k] += share.M[k];
    for (int k = 0; k < D; ++k) {
        sums.grad_1[k] += share.grad[k];
        sums.grad_delta[k] += of_delta.sum[k] - delta * share.grad[k];
        sums.shift[k] += share.shifted[k];
    }
    if (sums.grad_v) add_velocities<D>(share, at<D>(particles.v, i), *sums.grad_v);
}

template <int D>
double solid_divergence(const SolidView& solid, const Particles& particles, const Symmetric<D>& B, Index i) {
    LonelyFace face;
    if (solid.walls->find_lonely_face<D>(at<D>(particles.x, i), face)) {
        const std::array<double, D> past = velocity_past<D>(face, at<D>(particles.v, i));
        double across = 0.0;
        for (int k = 0; k < D; ++k) across += B(k, face.axis) * past[k];
        return face.sign * solid.walls->profile(face.distance).w * across;
    }
    WallShare<D> share;
    solid.walls->find_share<D>(at<D>(particles.x, i), -1.0, share);
    const std::array<double, D> v = at<D>(particles.v, i);
    double divergence = 0.0;
    for (int a = 0; a < share.count; ++a)
        divergence -= dot<D, double>(velocity_past<D>(share.part[a], v), B * share.part[a].grad);
    return divergence;
}

template <int D>
void add_solid_pressure(const SolidView& solid, const Particles& particles, Index i,
                        const PressureSums<D, double>& fluid, const std::array<double, D>& own,
                        PressureSums<D, double>& walls) {
    const double p = particles.p[i];
    const std::array<double, D> slope = scaled<D, double>(particles.rho[i], solid.gravity_on<D>(i));
    // D, and what becomes of it along the walls.
    std::array<double, D> of_fluid, change;
    for (int k = 0; k < D; ++k) {
        of_fluid[k] = fluid.pB_grad[k] - p * fluid.grad_1[k];
        change[k] = own[k] + p * fluid.grad_1[k];
    }
    LonelyFace face;
    if (solid.record == nullptr && solid.walls->find_lonely_face<D>(at<D>(particles.x, i), face)) {
        const WallProfile profile = solid.walls->profile(face.distance);
        walls.grad_1[face.axis] -= face.sign * profile.w;
        change[face.axis] = 0.0;
        add_to<D, double>(of_fluid, change);
        add_to<D, double>(walls.pB_grad, find_pressure<D>(face, profile, p, slope, of_fluid, solid.walls_suck));
        return;
    }
    WallShare<D> share;
    solid.walls->find_share<D>(at<D>(particles.x, i), -1.0, share);
    add_to<D, double>(walls.grad_1, share.grad);
    for (int a = 0; a < share.count; ++a) {
        const std::array<double, D>& n = share.part[a].n;
        const double across = dot<D, double>(change, n);
        for (int k = 0; k < D; ++k) change[k] -= across * n[k];
    }
    add_to<D, double>(of_fluid, change);
    SolidPressure<D> pressure;
    find_pressure<D>(share, p, slope, of_fluid, solid.walls_suck, solid.record != nullptr, pressure);
    add_to<D, double>(walls.pB_grad, pressure.sum);
    if (solid.record == nullptr) return;
    for (int a = 0; a < share.count; ++a) {
        SolidSums::OfObject& object = solid.record->objects[share.part[a].surface->object];
        for (int k = 0; k < D; ++k) {
            object.grad_1[k][i] += share.part[a].grad[k];
            object.pB_grad[k][i] += pressure.of_part[a][k];
        }
    }
}

template <int D>
void add_solid_viscosity(const SolidView& solid, const Particles& particles, const Symmetric<D>& B,
                         double least_distance, Index i, std::array<double, D>& sum) {
    WallShare<D> share;
    solid.walls->find_share<D>(at<D>(particles.x, i), least_distance, share);
    for (int a = 0; a < share.count; ++a)
        add_to<D, double>(sum, solid_viscosity<D>(share.part[a], at<D>(particles.v, i), B));
}

template void add_solid_geometry<2>(const SolidView&, const Particles&, double, Index, GeometryShares<2>);
template double solid_divergence<2>(const SolidView&, const Particles&, const Symmetric<2>&, Index);
template void add_solid_pressure<2>(const SolidView&, const Particles&, Index, const PressureSums<2, double>&,
                                    const std::array<double, 2>&, PressureSums<2, double>&);
template void add_solid_viscosity<2>(const SolidView&, const Particles&, const Symmetric<2>&, double, Index,
                                     std::array<double, 2>&);
template void add_solid_geometry<3>(const SolidView&, const Particles&, double, Index, GeometryShares<3>);
template double solid_divergence<3>(const SolidView&, const Particles&, const Symmetric<3>&, Index);
template void add_solid_pressure<3>(const SolidView&, const Particles&, Index, const PressureSums<3, double>&,
                                    const std::array<double, 3>&, PressureSums<3, double>&);
template void add_solid_viscosity<3>(const SolidView&, const Particles&, const Symmetric<3>&, double, Index,
                                     std::array<double, 3>&);

}  // namespace headrace::solver
