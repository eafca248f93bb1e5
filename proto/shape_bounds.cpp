#include "proto/shape_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace headrace::proto {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

BoxDesc bounds_of(const BoxDesc& box) {
    return box;
}

BoxDesc bounds_of(const SphereDesc& sphere) {
    BoxDesc bounds;
    for (int k = 0; k < 3; ++k) {
        bounds.min[k] = sphere.center[k] - sphere.radius;
        bounds.max[k] = sphere.center[k] + sphere.radius;
    }
    return bounds;
}

// A disc with unit normal n and radius r reaches r sqrt(1 - n_k^2) along axis k.
BoxDesc bounds_of(const CylinderDesc& cylinder) {
    Vec3 along;
    for (int k = 0; k < 3; ++k) along[k] = cylinder.to[k] - cylinder.from[k];
    const double length = std::hypot(along[0], along[1], along[2]);
    BoxDesc bounds;
    for (int k = 0; k < 3; ++k) {
        const double n = along[k] / length;
        const double reach = cylinder.radius * std::sqrt(std::max(0.0, 1.0 - n * n));
        bounds.min[k] = std::min(cylinder.from[k], cylinder.to[k]) - reach;
        bounds.max[k] = std::max(cylinder.from[k], cylinder.to[k]) + reach;
    }
    return bounds;
}

// Ends along an axis only when it is perpendicular to that axis.
BoxDesc bounds_of(const PlaneDesc& plane) {
    BoxDesc bounds{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
    for (int k = 0; k < 3; ++k) {
        if (plane.normal[(k + 1) % 3] != 0.0 || plane.normal[(k + 2) % 3] != 0.0) continue;
        (plane.normal[k] > 0.0 ? bounds.max : bounds.min)[k] = plane.point[k];
    }
    return bounds;
}

BoxDesc bounds_of(const DifferenceDesc& difference) {
    return difference.of.empty() ? BoxDesc{} : bounding_box(difference.of.front());
}

BoxDesc bounds_of(const IntersectionDesc& intersection) {
    if (intersection.of.empty()) return {};
    BoxDesc bounds = bounding_box(intersection.of.front());
    for (const ShapeDesc& part : intersection.of) {
        const BoxDesc box = bounding_box(part);
        for (int k = 0; k < 3; ++k) {
            bounds.min[k] = std::max(bounds.min[k], box.min[k]);
            bounds.max[k] = std::min(bounds.max[k], box.max[k]);
        }
    }
    return bounds;
}

}  // namespace

BoxDesc bounding_box(const ShapeDesc& shape) {
    return std::visit([](const auto& kind) { return bounds_of(kind); }, shape);
}

bool is_finite(const BoxDesc& box, int dimensions) {
    for (int k = 0; k < dimensions; ++k)
        if (!std::isfinite(box.min[k]) || !std::isfinite(box.max[k])) return false;
    return true;
}

}  // namespace headrace::proto
