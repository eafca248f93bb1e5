// How the solid's share of one particle's sums is put together from half-spaces, edges and corners; private to
// integral_walls.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/solver/boundaries/integral_walls.h"

namespace headrace::solver {

// The half-space beyond a plane: those y with sign y_axis > distance.
struct HalfSpace {
    int axis{};
    double sign{};
    double distance{};  // [m]
};

// A box obstacle seen from x: distance of its surface, outward normal there.
template <int D>
struct SeenBox {
    double distance{};
    std::array<double, D> n{};
};

template <int D>
SeenBox<D> look_at(const IntegralBox& box, const Vec3& x) {
    SeenBox<D> seen;
    double inside = -std::numeric_limits<double>::infinity(), out2 = 0.0;
    int nearest = 0;
    double sign = 1.0;
    for (int k = 0; k < D; ++k) {
        if (box.endless[k]) continue;
        const double low = box.low[k] - x[k], high = x[k] - box.high[k], excess = std::max(low, high);
        if (excess > inside) {
            inside = excess;
            nearest = k;
            sign = low > high ? -1.0 : 1.0;
        }
        if (excess > 0.0) {
            seen.n[k] = low > high ? -excess : excess;
            out2 += excess * excess;
        }
    }
    if (out2 > 0.0) {
        seen.distance = std::sqrt(out2);
        for (double& component : seen.n) component /= seen.distance;
    } else {
        seen.distance = inside;
        seen.n = {};
        seen.n[nearest] = sign;
    }
    return seen;
}

// Adds up the share of one particle.
template <int D>
class ShareSum {
  public:
    ShareSum(const IntegralWalls& walls, double least_distance, WallShare<D>& share)
        : walls_(walls), least_(least_distance), is_viscous_(least_distance >= 0.0), share_(share) {}

    void add_room(const Vec3& x) {
        std::array<HalfSpace, 2 * D> half;
        int first[D], last[D], count = 0;
        for (int k = 0; k < D; ++k) {
            first[k] = count;
            for (int side = 0; side < 2; ++side) {
                const IntegralFace& face = walls_.room_[k][side];
                if (!face.exists) continue;
                const double d = side == 0 ? x[k] - face.at : face.at - x[k];
                if (d >= walls_.support_) continue;
                half[count] = {k, side == 0 ? -1.0 : 1.0, d};
                add_face(half[count], face.surface);
                ++count;
            }
            last[k] = count;
        }
        if (count < 2) return;
        for (int k = 0; k < D; ++k) {
            for (int l = k + 1; l < D; ++l) {
                for (int a = first[k]; a < last[k]; ++a) {
                    for (int b = first[l]; b < last[l]; ++b) add_room_edge(half[a], half[b], a, b);
                }
            }
        }
        if constexpr (D == 3) {
            for (int a = first[0]; a < last[0]; ++a) {
                for (int b = first[1]; b < last[1]; ++b) {
                    for (int c = first[2]; c < last[2]; ++c) add_room_corner({half[a], half[b], half[c]}, {a, b, c});
                }
            }
        }
    }

    // The box is the product over the axes of what lies between its faces: of the half-space behind a face that x is in
    // front of; of all space less the two half-spaces beyond its faces where x is between them.
    void add_box(const IntegralBox& box, const Vec3& x) {
        const SeenBox<D> seen = look_at<D>(box, x);
        if (seen.distance >= walls_.support_) return;
        WallPart<D>& part = start_part(seen.n, seen.distance, box.surface);
        of_box_ = {};
        std::array<HalfSpace, D> front;
        int fronts = 0;
        std::array<HalfSpace, 2 * D> beyond;
        int beyonds = 0;
        int axis_in = -1;
        if (seen.distance <= 0.0) {
            for (int k = 0; k < D; ++k) {
                if (seen.n[k] != 0.0) axis_in = k;
            }
        }
        for (int k = 0; k < D; ++k) {
            if (box.endless[k]) continue;
            const double low = box.low[k] - x[k], high = x[k] - box.high[k];
            if (low > 0.0 || high > 0.0 || k == axis_in) {
                front[fronts++] = low > high ? HalfSpace{k, 1.0, low} : HalfSpace{k, -1.0, high};
                continue;
            }
            if (-low < walls_.support_) beyond[beyonds++] = {k, -1.0, -low};
            if (-high < walls_.support_) beyond[beyonds++] = {k, 1.0, -high};
        }
        add_product(front, fronts, beyond, beyonds, seen);
        add_to_share(of_box_, 1.0);
        part.grad = part.grad_n = of_box_.grad;
        part.m_n = dot<D, double>(part.n, of_box_.M * part.n);
        part.viscous = of_box_.viscous.e;
        part.gamma = of_box_.gamma;
    }

    void add_sphere(const IntegralSphere& sphere, const Vec3& x) {
        std::array<double, D> out;
        double r2 = 0.0;
        for (int k = 0; k < D; ++k) {
            out[k] = x[k] - sphere.center[k];
            r2 += out[k] * out[k];
        }
        const double r = std::sqrt(r2), d = sphere.is_container ? sphere.radius - r : r - sphere.radius;
        if (d >= walls_.support_ || !(r > 0.0)) return;
        for (double& component : out) component *= (sphere.is_container ? -1.0 : 1.0) / r;
        add_profile(sphere.profile, d, out, sphere.surface);
    }

  private:
    // Integrals over one region.
    struct Region {
        std::array<double, D> grad{}, shifted{};
        Symmetric<D> M, viscous;
        double gamma{};
    };

    WallPart<D>& start_part(const std::array<double, D>& n, double distance, const IntegralSurface& surface) {
        WallPart<D>& part = share_.part[share_.count++];
        part.n = n;
        part.distance = distance;
        part.surface = &surface;
        return part;
    }

    void add_to_share(const Region& region, double sign) {
        for (int k = 0; k < D; ++k) {
            share_.grad[k] += sign * region.grad[k];
            share_.shifted[k] += sign * region.shifted[k];
        }
        for (int k = 0; k < Symmetric<D>::kSize; ++k) share_.M[k] += sign * region.M.e[k];
    }

    void add_face(const HalfSpace& half, const IntegralSurface& surface) {
        std::array<double, D> n{};
        n[half.axis] = -half.sign;
        add_profile(walls_.plane_, half.distance, n, surface);
    }

    void add_profile(const WallProfileTable& table, double d, const std::array<double, D>& n,
                     const IntegralSurface& surface) {
        const WallProfile profile = table.plain(d);
        WallPart<D>& part = start_part(n, d, surface);
        part.m_n = profile.m_n;
        for (int k = 0; k < D; ++k) {
            part.grad_n[k] = part.grad[k] = -profile.w * n[k];
            share_.grad[k] += part.grad[k];
            share_.shifted[k] -= profile.w_shifted * n[k];
            for (int l = k; l < D; ++l) {
                share_.M[Symmetric<D>::index(k, l)] +=
                    (profile.m_n - profile.m_t) * n[k] * n[l] + (k == l ? profile.m_t : 0.0);
            }
        }
        if (!is_viscous_) return;
        const ViscousProfile viscous = table.viscous(d);
        part.gamma = viscous.gamma;
        const double inv_d = 1.0 / std::max(d, least_), n_part = viscous.k_n + viscous.l_n * inv_d,
                     t_part = viscous.k_t + viscous.l_t * inv_d;
        for (int k = 0; k < D; ++k) {
            for (int l = k; l < D; ++l)
                part.viscous[Symmetric<D>::index(k, l)] = (n_part - t_part) * n[k] * n[l] + (k == l ? t_part : 0.0);
        }
    }

    // visit(y, weight, section) for the rows of layers in the region that two half-spaces share; the section extends
    // along the remaining axis, where y is 0.
    template <class Visit>
    void for_each_row(const HalfSpace& a, const HalfSpace& b, Visit&& visit) const {
        const double reach2 = walls_.support_ * walls_.support_, step = walls_.layers_.thickness;
        std::array<double, D> y{};
        for (int k = 0; k < walls_.layers_.count; ++k) {
            const double y_a = a.distance + walls_.layers_.depth(k);
            if (y_a * y_a >= reach2) break;
            y[a.axis] = a.sign * y_a;
            for (int l = 0; l < walls_.layers_.count; ++l) {
                const double y_b = b.distance + walls_.layers_.depth(l), s2 = y_a * y_a + y_b * y_b;
                if (s2 >= reach2) break;
                y[b.axis] = b.sign * y_b;
                visit(y, step * step, walls_.edge_(std::sqrt(s2)));
            }
        }
    }

    // The same of three half-spaces.
    template <class Visit>
    void for_each_point(const std::array<HalfSpace, 3>& half, Visit&& visit) const {
        const double reach2 = walls_.support_ * walls_.support_, step = walls_.layers_.thickness;
        const auto& [a, b, c] = half;
        std::array<double, D> y{};
        for (int k = 0; k < walls_.layers_.count; ++k) {
            const double y_a = a.distance + walls_.layers_.depth(k);
            y[a.axis] = a.sign * y_a;
            for (int l = 0; l < walls_.layers_.count; ++l) {
                const double y_b = b.distance + walls_.layers_.depth(l), s2 = y_a * y_a + y_b * y_b;
                if (s2 >= reach2) break;
                y[b.axis] = b.sign * y_b;
                for (int m = 0; m < walls_.layers_.count; ++m) {
                    const double y_c = c.distance + walls_.layers_.depth(m), r2 = s2 + y_c * y_c;
                    if (r2 >= reach2) break;
                    y[c.axis] = c.sign * y_c;
                    visit(y, step * step * step, walls_.corner_(std::sqrt(r2)));
                }
            }
        }
    }

    // extent: of the section, along `axis`.
    static void add_row(Region& region, const std::array<double, D>& y, double weight, const Section& s, int axis) {
        const double F = weight * s.F, shifted = weight * s.F_shifted;
        for (int k = 0; k < D; ++k) {
            region.grad[k] -= F * y[k];
            region.shifted[k] -= shifted * y[k];
            for (int l = k; l < D; ++l) region.M(k, l) -= F * y[k] * y[l];
        }
        if (axis >= 0) region.M(axis, axis) -= weight * s.F_tt;
        region.gamma += weight * s.W;
    }

    // F y y/r^2 of a row.
    static Symmetric<D> viscous_of(const std::array<double, D>& y, double weight, const Section& s, int axis) {
        Symmetric<D> viscous;
        const double s2 = std::max(dot<D, double>(y, y), 1e-300), F = weight * s.F_yy_r2 / s2;
        for (int k = 0; k < D; ++k) {
            for (int l = k; l < D; ++l) viscous(k, l) = F * y[k] * y[l];
        }
        if (axis >= 0) viscous(axis, axis) += weight * s.F_tt_r2(1);
        return viscous;
    }

    static int other_axis(const HalfSpace& a, const HalfSpace& b) { return D == 2 ? -1 : 3 - a.axis - b.axis; }

    // 1 + depth/d of a point behind the face.
    double growth(const HalfSpace& half, const std::array<double, D>& y) const {
        return 1.0 + (std::abs(y[half.axis]) - half.distance) / std::max(half.distance, least_);
    }

    // Of the solid that faces of the room share: half to each, or all to the object that comes first in the scene.
    double owned_by(int a, int b) const {
        const Index of_a = share_.part[a].surface->object, of_b = share_.part[b].surface->object;
        return of_a == of_b ? 0.5 : of_a < of_b ? 1.0 : 0.0;
    }

    void add_room_edge(const HalfSpace& a, const HalfSpace& b, int part_a, int part_b) {
        if (a.distance * a.distance + b.distance * b.distance >= walls_.support_ * walls_.support_ &&
            a.distance > 0.0 && b.distance > 0.0)
            return;
        const int axis = other_axis(a, b);
        const double of_a = owned_by(part_a, part_b) - 1.0, of_b = -1.0 - of_a;
        Region both;
        for_each_row(a, b, [&](const std::array<double, D>& y, double weight, const Section& s) {
            add_row(both, y, weight, s, axis);
            if (is_viscous_) {
                const Symmetric<D> viscous = viscous_of(y, weight, s, axis);
                add_viscous(part_a, viscous, of_a * growth(a, y));
                add_viscous(part_b, viscous, of_b * growth(b, y));
            }
        });
        add_to_share(both, -1.0);
        for (int k = 0; k < D; ++k) {
            share_.part[part_a].grad[k] += of_a * both.grad[k];
            share_.part[part_b].grad[k] += of_b * both.grad[k];
        }
        if (!is_viscous_) return;
        share_.part[part_a].gamma += of_a * both.gamma;
        share_.part[part_b].gamma += of_b * both.gamma;
    }

    void add_room_corner(const std::array<HalfSpace, 3>& half, const std::array<int, 3>& parts) {
        double d2 = 0.0;
        for (const HalfSpace& one : half) d2 += std::max(one.distance, 0.0) * std::max(one.distance, 0.0);
        if (d2 >= walls_.support_ * walls_.support_) return;
        // Owned by all three, less what it was given by each pair, plus one.
        std::array<double, 3> share;
        double owners = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double one = owned_by(parts[k], parts[(k + 1) % 3]), other = owned_by(parts[k], parts[(k + 2) % 3]);
            share[k] = one * other;
            owners += share[k];
        }
        std::array<double, 3> weight_of;
        for (int k = 0; k < 3; ++k) {
            const double one = owned_by(parts[k], parts[(k + 1) % 3]), other = owned_by(parts[k], parts[(k + 2) % 3]);
            weight_of[k] = (owners > 0.0 ? share[k] / owners : 1.0 / 3.0) - one - other + 1.0;
        }
        Region all;
        for_each_point(half, [&](const std::array<double, D>& y, double weight, const Section& s) {
            add_row(all, y, weight, s, -1);
            if (is_viscous_) {
                const Symmetric<D> viscous = viscous_of(y, weight, s, -1);
                for (int k = 0; k < 3; ++k) add_viscous(parts[k], viscous, weight_of[k] * growth(half[k], y));
            }
        });
        add_to_share(all, 1.0);
        for (int k = 0; k < 3; ++k) {
            for (int axis = 0; axis < D; ++axis) share_.part[parts[k]].grad[axis] += weight_of[k] * all.grad[axis];
            if (is_viscous_) share_.part[parts[k]].gamma += weight_of[k] * all.gamma;
        }
    }

    void add_viscous(int part, const Symmetric<D>& viscous, double weight) {
        for (int k = 0; k < Symmetric<D>::kSize; ++k) share_.part[part].viscous[k] += weight * viscous.e[k];
    }

    // ---- obstacles --------------------------------------------------------------------------------------------------

    // sign times the region that all these half-spaces share, to the box's integrals.
    void add_region(const std::array<HalfSpace, 3>& half, int count, double sign, const SeenBox<D>& seen) {
        const double inv_d = 1.0 / std::max(seen.distance, is_viscous_ ? least_ : 1.0);
        const auto add = [&](const std::array<double, D>& y, double weight, const Section& s, int axis) {
            add_row(of_box_, y, sign * weight, s, axis);
            if (!is_viscous_) return;
            const double depth = std::max(-dot<D, double>(y, seen.n) - seen.distance, 0.0);
            const Symmetric<D> viscous = viscous_of(y, sign * weight * (1.0 + depth * inv_d), s, axis);
            for (int k = 0; k < Symmetric<D>::kSize; ++k) of_box_.viscous.e[k] += viscous.e[k];
        };
        if (count == 1) {
            const WallProfile profile = walls_.plane_.plain(half[0].distance);
            const int n = half[0].axis;
            of_box_.grad[n] += sign * half[0].sign * profile.w;
            of_box_.shifted[n] += sign * half[0].sign * profile.w_shifted;
            for (int k = 0; k < D; ++k) of_box_.M(k, k) += sign * (k == n ? profile.m_n : profile.m_t);
            if (!is_viscous_) return;
            const ViscousProfile viscous = walls_.plane_.viscous(half[0].distance);
            of_box_.gamma += sign * viscous.gamma;
            for (int k = 0; k < D; ++k) {
                of_box_.viscous(k, k) +=
                    sign * (k == n ? viscous.k_n + viscous.l_n * inv_d : viscous.k_t + viscous.l_t * inv_d);
            }
        } else if (count == 2) {
            const int axis = other_axis(half[0], half[1]);
            for_each_row(half[0], half[1],
                         [&](const auto& y, double weight, const Section& s) { add(y, weight, s, axis); });
        } else if constexpr (D == 3) {
            for_each_point(half, [&](const auto& y, double weight, const Section& s) { add(y, weight, s, -1); });
        }
    }

    // Product of the front half-spaces with (1 - beyond) for each axis between whose faces x is.
    void add_product(const std::array<HalfSpace, D>& front, int fronts, const std::array<HalfSpace, 2 * D>& beyond,
                     int beyonds, const SeenBox<D>& seen) {
        std::array<HalfSpace, 3> half;
        for (int k = 0; k < fronts; ++k) half[k] = front[k];
        if (fronts == 0) return;
        add_region(half, fronts, 1.0, seen);
        for (int a = 0; a < beyonds && fronts < D; ++a) {
            half[fronts] = beyond[a];
            add_region(half, fronts + 1, -1.0, seen);
            for (int b = a + 1; b < beyonds && fronts + 1 < D; ++b) {
                if (beyond[b].axis == beyond[a].axis) continue;
                half[fronts + 1] = beyond[b];
                add_region(half, fronts + 2, 1.0, seen);
            }
        }
    }

    const IntegralWalls& walls_;
    double least_;  // [m]
    bool is_viscous_;
    WallShare<D>& share_;
    Region of_box_;
};

}  // namespace headrace::solver
