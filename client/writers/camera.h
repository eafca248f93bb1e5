// From metres to pixels. Perspective three-quarter view of 3D scenes, orthographic front view of 2D scenes.
#pragma once

#include <optional>
#include <span>

#include "client/writers/vec3.h"

namespace headrace::client {

// Part of a picture, from its top left corner [px].
struct Viewport {
    double left{}, top{}, width{}, height{};
};

struct Projected {
    double x{}, y{};    // [px] from the top left; pixel (0, 0) covers 0..1
    double nearness{};  // larger is nearer; affine over the picture for points of a plane, so it interpolates linearly:
                        // 1/depth in perspective, -depth in orthographic views
};

class Camera {
  public:
    // Sees all of the points, centred in the viewport and as large as it fits. `up` is a unit coordinate axis.
    static Camera perspective(std::span<const Vec3> points, const Vec3& up, const Viewport& viewport);
    static Camera orthographic(std::span<const Vec3> points, const Vec3& up, const Viewport& viewport);

    // From an eye, or (`eye` absent) from far away: orthographic. `backward` points to the viewer, `up` is any
    // direction aside of it.
    static Camera looking(std::span<const Vec3> points, const std::optional<Vec3>& eye, const Vec3& backward,
                          const Vec3& up, const Viewport& viewport);

    Projected project(const Vec3& x) const;
    double pixels_per_metre(double nearness) const { return is_perspective_ ? focal_ * nearness : focal_; }
    // Change of nearness per metre towards the camera.
    double nearness_per_metre(double nearness) const { return is_perspective_ ? nearness * nearness : 1.0; }

    // Unit vector from `x` to the camera.
    Vec3 towards_eye(const Vec3& x) const;

    // The ray of all points seen at a pixel position: origin + s * direction, depth s.
    struct Ray {
        Vec3 origin, direction;
    };
    Ray ray(double x, double y) const {
        const double a = (x - x_center_) / focal_, b = (y_center_ - y) / focal_;
        const Vec3 aside = a * right_ + b * up_;
        return is_perspective_ ? Ray{eye_, aside - backward_} : Ray{eye_ + aside, -1 * backward_};
    }
    double nearness_at_depth(double depth) const { return is_perspective_ ? 1 / depth : -depth; }

    const Vec3& eye() const { return eye_; }  // of perspective views
    bool is_perspective() const { return is_perspective_; }
    const Vec3& right() const { return right_; }
    const Vec3& up() const { return up_; }
    const Vec3& backward() const { return backward_; }  // towards the viewer

    // The same view on a picture `factor` times as large.
    Camera magnified(double factor) const;

    // So many times as large about the viewport's middle; with a target, that moves there.
    Camera zoomed(double factor, const Viewport& viewport) const;
    Camera zoomed(double factor, const Vec3& target, const Viewport& viewport) const;

    // The smallest part of the picture that shows all of the points.
    Viewport covered(std::span<const Vec3> points) const;

  private:
    void fit(std::span<const Vec3> points, const Viewport& viewport);

    bool is_perspective_{true};
    Vec3 eye_{};
    Vec3 right_{1, 0, 0}, up_{0, 1, 0}, backward_{0, 0, 1};
    double focal_{1};                 // [px] per unit of tangent, or per metre when orthographic
    double x_center_{}, y_center_{};  // [px]
};

}  // namespace headrace::client
