// Axis-aligned box. Container: Staubach 2010, Eq. 2.42-2.47. Obstacle: ours, swept along the step so that no panel is
// too thin to hold.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "server/solver/boundaries/contact.h"

namespace headrace::solver {

template <int D>
struct BoxBoundary {
    Point<D> c;    // [m] centre
    Point<D> ext;  // [m] half extents

    double low(int axis) const { return c[axis] - ext[axis]; }
    double high(int axis) const { return c[axis] + ext[axis]; }

    // F = max(|x_l| - ext) with x_l = x - c (2.42): > 0 outside. Written with the faces, so that a particle put on a
    // face is exactly on it.
    double F(const Point<D>& x) const {
        double F = -std::numeric_limits<double>::infinity();
        for (int k = 0; k < D; ++k) F = std::max({F, low(k) - x[k], x[k] - high(k)});
        return F;
    }

    // As container, for F(x) > 0: cp is the nearest point of the box (2.43, 2.44), d = |cp - x|, n the unit vector
    // along cp - x. Differs from 2.47 as printed, whose sgn(cp_l - x_l) would not be the normal at a corner.
    Contact<D> container_contact(const Point<D>& x) const {
        Contact<D> contact;
        for (int k = 0; k < D; ++k) contact.cp[k] = std::clamp(x[k], low(k), high(k));
        const Point<D> inward = difference<D>(contact.cp, x);
        contact.d = std::sqrt(dot<D>(inward, inward));
        contact.n = inward;
        // A depth whose square underflows has no usable direction; the particle is on the face all the same.
        const double scale = contact.d > 0.0 ? 1.0 / contact.d : 0.0;
        for (double& component : contact.n) component *= scale;
        return contact;
    }

    // True where the boxes around the step's path and the object do not touch: nothing to do.
    bool is_clear_of(const Point<D>& x0, const Point<D>& x1) const {
        for (int k = 0; k < D; ++k) {
            if (std::max(x0[k], x1[k]) <= low(k) || std::min(x0[k], x1[k]) >= high(k)) return true;
        }
        return false;
    }

    // As obstacle: where the path x0 -> x1 enters the open box, the particle is put on the plane of the face it
    // entered by, at x1 otherwise (the orthogonal projection of 2.48). Touching or sliding along a face is no entry.
    std::optional<Contact<D>> entry_contact(const Point<D>& x0, const Point<D>& x1) const {
        double t_enter = -std::numeric_limits<double>::infinity();
        double t_leave = std::numeric_limits<double>::infinity();
        int axis = 0;
        for (int k = 0; k < D; ++k) {
            const double step = x1[k] - x0[k];
            if (step == 0.0) {
                if (x0[k] <= low(k) || x0[k] >= high(k)) return std::nullopt;
                continue;
            }
            const double t_low = (low(k) - x0[k]) / step, t_high = (high(k) - x0[k]) / step;
            const double t_in = std::min(t_low, t_high);
            if (t_in > t_enter) {
                t_enter = t_in;
                axis = k;
            }
            t_leave = std::min(t_leave, std::max(t_low, t_high));
        }
        if (!(t_enter >= 0.0 && t_enter < 1.0 && t_enter < t_leave)) return std::nullopt;
        return face_contact(x1, axis, x1[axis] > x0[axis] ? -1.0 : 1.0);
    }

    // Put on the plane of the face that looks along side * e_axis.
    Contact<D> face_contact(const Point<D>& x, int axis, double side) const {
        Contact<D> contact{x, {}, 0.0};
        contact.cp[axis] = side < 0.0 ? low(axis) : high(axis);
        contact.n[axis] = side;
        contact.d = std::abs(contact.cp[axis] - x[axis]);
        return contact;
    }

    // As obstacle, for a particle found inside without having entered (the object was added or moved): the nearest
    // face whose contact point is_free, or the nearest of all when none is; ties go to the lower axis, lower side.
    template <class IsFree>
    Contact<D> nearest_face_contact(const Point<D>& x, IsFree&& is_free) const {
        std::optional<Contact<D>> best, best_free;
        for (int k = 0; k < D; ++k) {
            for (const double side : {-1.0, 1.0}) {
                const Contact<D> face = face_contact(x, k, side);
                if (!best || face.d < best->d) best = face;
                if ((!best_free || face.d < best_free->d) && is_free(face.cp)) best_free = face;
            }
        }
        return best_free ? *best_free : *best;
    }
};

}  // namespace headrace::solver
