#include "tests/validation/support/leaks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace headrace::validation {

namespace {

// Signed distances [m], negative inside.
double distance(const proto::BoxDesc& box, const proto::Vec3& x, int dimensions) {
    double inside = -std::numeric_limits<double>::infinity();
    double outside = 0.0;
    for (int k = 0; k < dimensions; ++k) {
        const double d = std::max(box.min[k] - x[k], x[k] - box.max[k]);
        inside = std::max(inside, d);
        outside += std::pow(std::max(d, 0.0), 2);
    }
    return inside < 0.0 ? inside : std::sqrt(outside);
}

double distance(const proto::SphereDesc& sphere, const proto::Vec3& x, int dimensions) {
    double square = 0.0;
    for (int k = 0; k < dimensions; ++k) square += std::pow(x[k] - sphere.center[k], 2);
    return std::sqrt(square) - sphere.radius;
}

double distance(const proto::PlaneDesc& plane, const proto::Vec3& x, int dimensions) {
    double along = 0.0, length = 0.0;
    for (int k = 0; k < dimensions; ++k) {
        along += (x[k] - plane.point[k]) * plane.normal[k];
        length += plane.normal[k] * plane.normal[k];
    }
    return along / std::sqrt(length);
}

double distance(const proto::CylinderDesc& cylinder, const proto::Vec3& x, int) {
    double length = 0.0, along = 0.0;
    for (int k = 0; k < 3; ++k) length += std::pow(cylinder.to[k] - cylinder.from[k], 2);
    length = std::sqrt(length);
    for (int k = 0; k < 3; ++k) along += (x[k] - cylinder.from[k]) * (cylinder.to[k] - cylinder.from[k]) / length;
    double square = 0.0;
    for (int k = 0; k < 3; ++k)
        square += std::pow(x[k] - cylinder.from[k] - along * (cylinder.to[k] - cylinder.from[k]) / length, 2);
    return std::max({-along, along - length, std::sqrt(square) - cylinder.radius});
}

template <class Compound>
double distance(const Compound&, const proto::Vec3&, int) {
    return -std::numeric_limits<double>::infinity();  // never the shape of an object
}

}  // namespace

double depth_behind(const proto::ObjectDesc& object, const proto::Vec3& x, int dimensions) {
    const double d = std::visit([&](const auto& shape) { return distance(shape, x, dimensions); },
                                static_cast<const proto::ShapeDesc::variant&>(object.shape));
    const bool is_plane = std::holds_alternative<proto::PlaneDesc>(object.shape);
    return !is_plane && object.role == proto::ObjectRole::container ? d : -d;
}

void LeakCount::sample(const scene::Run& run) {
    const solver::Particles& particles = run.particles();
    const int dimensions = particles.dimensions;
    std::size_t count = particles_ - std::min(particles_, particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        proto::Vec3 x{};
        for (int k = 0; k < dimensions; ++k) x[k] = particles.x[k][i];
        const bool is_behind = std::any_of(run.objects().begin(), run.objects().end(), [&](const auto& object) {
            return depth_behind(object, x, dimensions) > 1e-9 * run.scene().spacing;  // round-off of a clamped place
        });
        if (is_behind) ++count;
    }
    most_ = std::max(most_, count);
}

}  // namespace headrace::validation
