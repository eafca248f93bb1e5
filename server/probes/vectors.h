// Small vector arithmetic of the probes. In 2D the third component is 0.
#pragma once

#include <cmath>

#include "server/solver/particles.h"

namespace headrace::probes {

using solver::Vec3;

inline double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vec3 minus(const Vec3& a, const Vec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// a + s (b - a)
inline Vec3 between(const Vec3& a, const Vec3& b, double s) {
    return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}

inline double length(const Vec3& a) {
    return std::hypot(a[0], a[1], a[2]);
}

// Precondition: a is not zero.
inline Vec3 unit(const Vec3& a) {
    const double l = length(a);
    return {a[0] / l, a[1] / l, a[2] / l};
}

}  // namespace headrace::probes
