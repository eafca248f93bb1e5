// What a collision does to a particle, Staubach 2010, Eq. 2.48 and 2.51.
#pragma once

#include "server/solver/boundaries/contact.h"

namespace headrace::solver {

// x = cp (2.48); v -= (1 + c_R d/(dt |v|)) (v.n) n (2.51), on the leap velocity, the state that is carried.
// c_R [1] restitution. As in the thesis, v.n is removed whatever its sign: particles stick to walls. A particle at
// rest has nothing to reflect.
template <int D>
void apply_response(const Contact<D>& contact, double restitution, double dt, Point<D>& x, Point<D>& v) {
    x = contact.cp;
    const double speed = std::sqrt(dot<D>(v, v));
    if (speed == 0.0) return;
    const double v_n = dot<D>(v, contact.n);
    const double removed = v_n + restitution * contact.d / dt * (v_n / speed);
    for (int k = 0; k < D; ++k) v[k] -= removed * contact.n[k];
}

}  // namespace headrace::solver
