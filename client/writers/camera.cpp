#include "client/writers/camera.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "client/writers/boxes.h"

namespace headrace::client {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAzimuth = 27 * kDegree;    // from the front towards the right; chosen by looking
constexpr double kElevation = 17 * kDegree;  // above the horizon
constexpr double kDistance = 4.2;            // from the centre, in radii of the bounds: a mild perspective

// Horizontal axes of the front view: x to the right and z to the viewer where y is up.
Vec3 front_right(const Vec3& up) {
    const Vec3 x{1, 0, 0}, z{0, 0, 1};
    return std::abs(up[0]) > 0.5 ? cross(up, z) : x;
}

}  // namespace

Camera Camera::perspective(std::span<const Vec3> points, const Vec3& up, const Viewport& viewport) {
    Camera camera;
    const Vec3 right = front_right(up), front = cross(right, up);
    camera.right_ = std::cos(kAzimuth) * right - std::sin(kAzimuth) * front;
    const Vec3 level = std::sin(kAzimuth) * right + std::cos(kAzimuth) * front;
    camera.backward_ = std::cos(kElevation) * level + std::sin(kElevation) * up;
    camera.up_ = cross(camera.backward_, camera.right_);
    const proto::BoxDesc bounds = bounds_of(points);
    const Vec3 center = 0.5 * (bounds.min + bounds.max);
    camera.eye_ = center + (kDistance * 0.5 * length(bounds.max - bounds.min)) * camera.backward_;
    camera.fit(points, viewport);
    return camera;
}

Camera Camera::orthographic(std::span<const Vec3> points, const Vec3& up, const Viewport& viewport) {
    Camera camera;
    camera.is_perspective_ = false;
    camera.right_ = front_right(up);
    camera.up_ = up;
    camera.backward_ = cross(camera.right_, camera.up_);
    camera.fit(points, viewport);
    return camera;
}

Camera Camera::looking(std::span<const Vec3> points, const std::optional<Vec3>& eye, const Vec3& backward,
                       const Vec3& up, const Viewport& viewport) {
    Camera camera;
    camera.is_perspective_ = eye.has_value();
    camera.eye_ = eye.value_or(Vec3{});
    camera.backward_ = normalized(backward);
    camera.right_ = normalized(cross(up, camera.backward_));
    camera.up_ = cross(camera.backward_, camera.right_);
    camera.fit(points, viewport);
    return camera;
}

Camera Camera::zoomed(double factor, const Viewport& viewport) const {
    const double x = viewport.left + 0.5 * viewport.width, y = viewport.top + 0.5 * viewport.height;
    Camera camera = *this;
    camera.focal_ *= factor;
    camera.x_center_ = x + factor * (x_center_ - x);
    camera.y_center_ = y + factor * (y_center_ - y);
    return camera;
}

Camera Camera::zoomed(double factor, const Vec3& target, const Viewport& viewport) const {
    Camera camera = zoomed(factor, viewport);
    const Projected seen = camera.project(target);
    camera.x_center_ += viewport.left + 0.5 * viewport.width - seen.x;
    camera.y_center_ += viewport.top + 0.5 * viewport.height - seen.y;
    return camera;
}

// Scale and shift are affine in the picture, so one look at the points is enough.
void Camera::fit(std::span<const Vec3> points, const Viewport& viewport) {
    focal_ = 1;
    x_center_ = y_center_ = 0;
    const Viewport seen = covered(points);
    focal_ = std::min(viewport.width / seen.width, viewport.height / seen.height);
    x_center_ = viewport.left + 0.5 * viewport.width - focal_ * (seen.left + 0.5 * seen.width);
    y_center_ = viewport.top + 0.5 * viewport.height - focal_ * (seen.top + 0.5 * seen.height);
}

Viewport Camera::covered(std::span<const Vec3> points) const {
    constexpr double kFar = std::numeric_limits<double>::max();
    double left = kFar, right = -kFar, top = kFar, bottom = -kFar;
    for (const Vec3& point : points) {
        const Projected seen = project(point);
        left = std::min(left, seen.x), right = std::max(right, seen.x);
        top = std::min(top, seen.y), bottom = std::max(bottom, seen.y);
    }
    return {left, top, right - left, bottom - top};
}

Projected Camera::project(const Vec3& x) const {
    const Vec3 offset = x - eye_;
    const double depth = -dot(offset, backward_);
    const double nearness = nearness_at_depth(depth);
    const double scale = pixels_per_metre(nearness);
    return {x_center_ + scale * dot(offset, right_), y_center_ - scale * dot(offset, up_), nearness};
}

Vec3 Camera::towards_eye(const Vec3& x) const {
    return is_perspective_ ? normalized(eye_ - x) : backward_;
}

Camera Camera::magnified(double factor) const {
    Camera camera = *this;
    camera.focal_ *= factor;
    camera.x_center_ *= factor;
    camera.y_center_ *= factor;
    return camera;
}

}  // namespace headrace::client
