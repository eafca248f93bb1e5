// Just enough vector algebra for shapes and motions.
#pragma once

#include <cmath>

#include "proto/scene_desc.h"

namespace headrace::scene {

inline proto::Vec3 plus(const proto::Vec3& a, const proto::Vec3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline proto::Vec3 minus(const proto::Vec3& a, const proto::Vec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline proto::Vec3 scaled(double s, const proto::Vec3& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const proto::Vec3& a, const proto::Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double norm(const proto::Vec3& a) {
    return std::hypot(a[0], a[1], a[2]);
}
// Precondition: a is not zero.
inline proto::Vec3 normalized(const proto::Vec3& a) {
    return scaled(1.0 / norm(a), a);
}

}  // namespace headrace::scene
