#include "server/solver/boundaries/primitives.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/solver/boundaries/rigid_motion.h"

namespace headrace::solver {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Lengths this close count as equal: round-off of faces given as decimal numbers.
constexpr double kTolerance = 1e-9;

// Distance of a solid shape, positive outside, its normal pointing away from it. `excess` over the faces along
// directions that are at right angles; a direction without faces has the excess -infinity.
SurfacePoint solid_distance(const std::array<double, 3>& excess, const std::array<Vec3, 3>& direction) {
    const int largest = static_cast<int>(std::max_element(excess.begin(), excess.end()) - excess.begin());
    Vec3 out{};
    for (int k = 0; k < 3; ++k) {
        if (excess[k] > 0.0) out = rigid::plus(out, rigid::times(excess[k], direction[k]));
    }
    const double distance = rigid::length(out);
    if (distance > 0.0) return {distance, rigid::times(1.0 / distance, out)};
    return {excess[largest], direction[largest]};
}

SurfacePoint solid_distance(const Body& body, const Box& box, const Vec3& X) {
    std::array<double, 3> excess{-kInfinity, -kInfinity, -kInfinity};
    std::array<Vec3, 3> direction{};
    for (int k = 0; k < body.dimensions; ++k) {
        const double x_c = X[k] - box.center[k];
        direction[k][k] = x_c < 0.0 ? -1.0 : 1.0;
        if (!body.endless[k]) excess[k] = std::abs(x_c) - box.half_extent[k];
    }
    return solid_distance(excess, direction);
}

SurfacePoint solid_distance(const Body& body, const Sphere& sphere, const Vec3& X) {
    Vec3 out = rigid::minus(X, sphere.center);
    if (body.dimensions == 2) out[2] = 0.0;
    const double distance = rigid::length(out);
    if (distance > 0.0) return {distance - sphere.radius, rigid::times(1.0 / distance, out)};
    return {-sphere.radius, {0.0, 1.0, 0.0}};
}

SurfacePoint solid_distance(const Body& body, const Cylinder& cylinder, const Vec3& X) {
    const Vec3 x_c = rigid::minus(X, cylinder.center);
    const double along = rigid::dot(x_c, cylinder.axis);
    const Vec3 out = rigid::minus(x_c, rigid::times(along, cylinder.axis));
    const double radius = rigid::length(out);
    Vec3 radial = rigid::times(1.0 / radius, out);
    if (!(radius > 0.0)) {  // on the axis: any direction at right angles to it
        const Vec3 other = std::abs(cylinder.axis[0]) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
        radial = rigid::cross(cylinder.axis, other);
        radial = rigid::times(1.0 / rigid::length(radial), radial);
    }
    return solid_distance(
        {radius - cylinder.radius, body.is_endless() ? -kInfinity : std::abs(along) - cylinder.half_length, -kInfinity},
        {radial, rigid::times(along < 0.0 ? -1.0 : 1.0, cylinder.axis), Vec3{}});
}

SurfacePoint solid_distance(const Body&, const Plane& plane, const Vec3& X) {
    return {rigid::dot(rigid::minus(X, plane.point), plane.normal), plane.normal};
}

std::array<bool, 3> endless_axes(const CollisionObject& object, const Domain& domain, int dimensions) {
    std::array<bool, 3> endless{};
    for (int k = 0; k < dimensions; ++k) {
        const double period = (domain.max[k] - domain.min[k]) * (1.0 - kTolerance);
        double extent = 0.0;  // [m]
        if (const Box* box = std::get_if<Box>(&object.shape)) {
            extent = 2.0 * box->half_extent[k];
        } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&object.shape)) {
            if (std::abs(cylinder->axis[k]) > 1.0 - kTolerance) extent = 2.0 * cylinder->half_length;
        }
        endless[k] = domain.periodic[k] && extent >= period;
    }
    return endless;
}

}  // namespace

Body make_body(const CollisionObject& object, const Domain& domain, int dimensions) {
    const bool is_plane = std::holds_alternative<Plane>(object.shape);
    return {dimensions, object.shape, object.role == Role::container && !is_plane,
            endless_axes(object, domain, dimensions)};
}

SurfacePoint nearest_surface(const Body& body, const Vec3& X) {
    SurfacePoint surface = std::visit([&](const auto& shape) { return solid_distance(body, shape, X); }, body.shape);
    if (body.is_container) surface = {-surface.distance, rigid::times(-1.0, surface.normal)};
    return surface;
}

Vec3 center_of(const Primitive& shape) {
    if (const Plane* plane = std::get_if<Plane>(&shape)) return plane->point;
    if (const Box* box = std::get_if<Box>(&shape)) return box->center;
    if (const Sphere* sphere = std::get_if<Sphere>(&shape)) return sphere->center;
    return std::get<Cylinder>(shape).center;
}

double bounding_radius(const Body& body) {
    if (body.is_endless()) return kInfinity;
    if (const Box* box = std::get_if<Box>(&body.shape)) {
        Vec3 half = box->half_extent;
        if (body.dimensions == 2) half[2] = 0.0;
        return rigid::length(half);
    }
    if (const Sphere* sphere = std::get_if<Sphere>(&body.shape)) return sphere->radius;
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&body.shape)) {
        return std::hypot(cylinder->radius, cylinder->half_length);
    }
    return kInfinity;
}

}  // namespace headrace::solver
