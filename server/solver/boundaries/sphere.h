// Sphere (2D: disc) as container or obstacle, Staubach 2010, Eq. 2.38-2.41:
//   F = |x - c|^2 - r^2, cp = c + r (x - c)/|x - c|, d = ||c - x| - r|, n = sgn(F) (c - x)/|c - x|.
// A container catches F > 0, an obstacle F < 0. At the very centre, where no direction exists, a particle leaves
// along +y.
#pragma once

#include "server/solver/boundaries/contact.h"

namespace headrace::solver {

template <int D>
struct SphereBoundary {
    Point<D> c;  // [m] centre
    double r;    // [m] radius

    double F(const Point<D>& x) const {
        const Point<D> x_c = difference<D>(x, c);
        return dot<D>(x_c, x_c) - r * r;
    }

    // Precondition: F(x) != 0, and x is on the wrong side.
    Contact<D> contact(const Point<D>& x) const {
        Point<D> out = difference<D>(x, c);
        const double distance = std::sqrt(dot<D>(out, out));
        if (distance > 0.0) {
            for (double& component : out) component /= distance;
        } else {
            out = {};
            out[1] = 1.0;
        }
        Contact<D> contact;
        const double sign = distance > r ? -1.0 : 1.0;  // of n along (x - c)
        for (int k = 0; k < D; ++k) {
            contact.cp[k] = c[k] + r * out[k];
            contact.n[k] = sign * out[k];
        }
        contact.d = std::abs(distance - r);
        return contact;
    }
};

}  // namespace headrace::solver
