// Just enough vector algebra for drawing.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

// Corner k of a box, 0 <= k < 8: bit 0 takes x, bit 1 y, bit 2 z from max.
inline Vec3 box_corner(const proto::BoxDesc& box, int k) {
    return {(k & 1 ? box.max : box.min)[0], (k & 2 ? box.max : box.min)[1], (k & 4 ? box.max : box.min)[2]};
}

// ---- boxes: unions start from kNowhere ----

inline constexpr double kInfinitelyFarAway = std::numeric_limits<double>::infinity();
inline constexpr proto::BoxDesc kNowhere{{kInfinitelyFarAway, kInfinitelyFarAway, kInfinitelyFarAway},
                                         {-kInfinitelyFarAway, -kInfinitelyFarAway, -kInfinitelyFarAway}};

inline bool is_nowhere(const proto::BoxDesc& box) {
    return box.min[0] > box.max[0];
}
inline void include(proto::BoxDesc& bounds, const proto::BoxDesc& box) {
    for (std::size_t k = 0; k < 3; ++k) {
        bounds.min[k] = std::min(bounds.min[k], box.min[k]);
        bounds.max[k] = std::max(bounds.max[k], box.max[k]);
    }
}
// What two boxes have in common; `box` where that is nothing.
inline proto::BoxDesc common_part(const proto::BoxDesc& box, const proto::BoxDesc& other) {
    proto::BoxDesc common = box;
    for (std::size_t k = 0; k < 3; ++k) {
        common.min[k] = std::max(box.min[k], other.min[k]);
        common.max[k] = std::min(box.max[k], other.max[k]);
        if (common.min[k] > common.max[k]) return box;
    }
    return common;
}
inline proto::BoxDesc grown(const proto::BoxDesc& box, double margin) {
    return {{box.min[0] - margin, box.min[1] - margin, box.min[2] - margin},
            {box.max[0] + margin, box.max[1] + margin, box.max[2] + margin}};
}

}  // namespace headrace::client
