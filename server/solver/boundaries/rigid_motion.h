// Rigid motion of a body: from its own frame (the scene's, at rest) to the world and back, velocity and acceleration
// of its points. Symbols as at RigidState: x = pivot + translation + R (X - pivot).
#pragma once

#include <cmath>

#include "server/solver/objects.h"

namespace headrace::solver::rigid {

inline Vec3 plus(const Vec3& a, const Vec3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 minus(const Vec3& a, const Vec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 times(double factor, const Vec3& a) {
    return {factor * a[0], factor * a[1], factor * a[2]};
}
inline double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vec3& a) {
    return std::sqrt(dot(a, a));
}

// R a, and its inverse.
inline Vec3 rotate(const RigidState& s, const Vec3& a) {
    const auto& R = s.rotation;
    return {R[0] * a[0] + R[1] * a[1] + R[2] * a[2], R[3] * a[0] + R[4] * a[1] + R[5] * a[2],
            R[6] * a[0] + R[7] * a[1] + R[8] * a[2]};
}
inline Vec3 rotate_back(const RigidState& s, const Vec3& a) {
    const auto& R = s.rotation;
    return {R[0] * a[0] + R[3] * a[1] + R[6] * a[2], R[1] * a[0] + R[4] * a[1] + R[7] * a[2],
            R[2] * a[0] + R[5] * a[1] + R[8] * a[2]};
}

inline Vec3 to_world(const RigidState& s, const Vec3& X) {
    return plus(plus(s.pivot, s.translation), rotate(s, minus(X, s.pivot)));
}
inline Vec3 to_body(const RigidState& s, const Vec3& x) {
    return plus(s.pivot, rotate_back(s, minus(minus(x, s.pivot), s.translation)));
}

// [m/s] of the body's point now at x: v + omega x r, r from the pivot.
inline Vec3 velocity(const RigidState& s, const Vec3& x) {
    const Vec3 r = minus(minus(x, s.pivot), s.translation);
    return plus(s.velocity, cross(s.angular_velocity, r));
}

// [m/s^2] of the body's point now at x: a + alpha x r + omega x (omega x r).
inline Vec3 acceleration(const RigidState& s, const Vec3& x) {
    const Vec3 r = minus(minus(x, s.pivot), s.translation);
    const Vec3 centripetal = cross(s.angular_velocity, cross(s.angular_velocity, r));
    return plus(s.acceleration, plus(cross(s.angular_acceleration, r), centripetal));
}

inline bool is_same_place(const RigidState& a, const RigidState& b) {
    return a.pivot == b.pivot && a.translation == b.translation && a.rotation == b.rotation;
}
inline bool is_same_motion(const RigidState& a, const RigidState& b) {
    return a.velocity == b.velocity && a.acceleration == b.acceleration && a.angular_velocity == b.angular_velocity &&
           a.angular_acceleration == b.angular_acceleration && a.surface_velocity == b.surface_velocity;
}

}  // namespace headrace::solver::rigid
