// Just enough vector algebra for drawing.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "proto/scene_desc.h"

namespace headrace::client {

using proto::Vec3;

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 operator*(double s, const Vec3& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double length(const Vec3& a) {
    return std::sqrt(dot(a, a));
}
inline Vec3 normalized(const Vec3& a) {
    return (1 / length(a)) * a;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Two unit vectors at right angles to a unit vector and to each other; cross(first, second) = axis.
inline std::pair<Vec3, Vec3> perpendiculars(const Vec3& axis) {
    const Vec3 other = std::abs(axis[1]) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    const Vec3 first = normalized(cross(other, axis));
    return {first, cross(axis, first)};
}

// Points all around, counter-clockwise about the unit vector `normal`.
inline std::vector<Vec3> circle(const Vec3& center, double radius, const Vec3& normal, int count) {
    const auto [side, front] = perpendiculars(normal);
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * k / count;
        points.push_back(center + radius * (std::cos(angle) * side + std::sin(angle) * front));
    }
    return points;
}

}  // namespace headrace::client
