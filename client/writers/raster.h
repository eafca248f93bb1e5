// A z-buffer for spheres, polygons and lines: each primitive is hidden where something opaque is nearer. Rasterised at
// twice the size and averaged, so edges are smooth. Own code and not cairo, because 100,000 depth-sorted discs take
// cairo seconds and this tens of milliseconds, and because particles hide each other pixel by pixel here.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "client/writers/boxes.h"
#include "client/writers/camera.h"
#include "client/writers/image.h"

namespace headrace::client {

class Raster {
  public:
    // `clip`: nothing is drawn beyond it. [px]
    Raster(int width, int height, const Camera& camera, const std::optional<Viewport>& clip = {});

    void clear(Rgb color);  // infinitely far

    // Opaque, shaded. Drawn as a disc: exact where the radius is small against the distance.
    void particle(const Vec3& center, double radius, Rgb color);

    // Translucent: blended over what is there with 0 <= alpha <= 1 and hides nothing drawn later.
    void polygon(std::span<const Vec3> corners, Rgb color, double alpha);  // convex, plane
    void line(const Vec3& from, const Vec3& to, double width_px, Rgb color, double alpha);

    // Calls shade(normal, to_eye) for each pixel that sees the sphere's near (or far) half; it returns colour and
    // alpha.
    struct Tint {
        Rgb color;
        double alpha;
    };
    enum class Half { near, far };
    template <class Shade>
    void sphere(const Vec3& center, double radius, Half half, const Shade& shade);

    void resolve(Image& image) const;  // precondition: width x height as here
    const Camera& camera() const { return camera_; }

  private:
    struct Range {
        int x0, x1, y0, y1;  // x0 <= x < x1
    };
    Range clipped(double left, double right, double top, double bottom) const;
    static std::uint32_t parts(double alpha) { return static_cast<std::uint32_t>(256 * alpha + 0.5); }  // of 256
    void blend(std::size_t pixel, Rgb color, std::uint32_t part);

    static constexpr int kOversampling = 2;  // in each direction
    int width_, height_;                     // of the buffers
    Range window_;                           // of the buffers, where anything is drawn
    Camera camera_;                          // in pictures pixels
    Camera fine_;                            // in buffer pixels
    std::vector<float> nearness_;            // of the nearest opaque surface
    std::vector<std::uint32_t> color_;       // 0xFFRRGGBB
};

template <class Shade>
void Raster::sphere(const Vec3& center, double radius, Half half, const Shade& shade) {
    // The sphere lies in its bounding cube, and the cube's picture within its corners'.
    const proto::BoxDesc cube{center - Vec3{radius, radius, radius}, center + Vec3{radius, radius, radius}};
    double left = width_, right = 0, top = height_, bottom = 0;
    for (int k = 0; k < 8; ++k) {
        const Projected corner = fine_.project(box_corner(cube, k));
        left = std::min(left, corner.x), right = std::max(right, corner.x);
        top = std::min(top, corner.y), bottom = std::max(bottom, corner.y);
    }
    const Range range = clipped(left, right, top, bottom);
    for (int y = range.y0; y < range.y1; ++y)
        for (int x = range.x0; x < range.x1; ++x) {
            // |origin + s direction - center|^2 = radius^2, solved for the depth s.
            const Camera::Ray ray = fine_.ray(x + 0.5, y + 0.5);
            const Vec3 from_center = ray.origin - center;
            const double a = dot(ray.direction, ray.direction), b = dot(ray.direction, from_center);
            const double discriminant = b * b - a * (dot(from_center, from_center) - radius * radius);
            if (discriminant <= 0) continue;
            const double root = std::sqrt(discriminant);
            const double depth = (half == Half::near ? -b - root : -b + root) / a;
            const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
            if (fine_.nearness_at_depth(depth) < nearness_[pixel]) continue;
            const Tint tint =
                shade((1 / radius) * (from_center + depth * ray.direction), root / (radius * std::sqrt(a)));
            blend(pixel, tint.color, parts(tint.alpha));
        }
}

}  // namespace headrace::client
