// Shapes and objects by themselves: finite, with an extent. What documents from JSON were asked already; scenes made in
// code were not.
#include <cmath>

#include "server/scene/shapes.h"
#include "server/scene/validate.h"
#include "server/scene/vectors.h"

namespace headrace::scene {

namespace {

using proto::Done;
using proto::Error;
using proto::ErrorCode;
using proto::Status;
using proto::Vec3;

Error invalid(std::string path, std::string message, std::string hint) {
    return {ErrorCode::scene_invalid, std::move(message), std::move(path), std::move(hint)};
}

bool is_finite(const Vec3& x, int dimensions) {
    for (int k = 0; k < dimensions; ++k)
        if (!std::isfinite(x[k])) return false;
    return true;
}

Status check(const proto::BoxDesc& box, int dimensions, const std::string& path) {
    for (int k = 0; k < dimensions; ++k) {
        if (!std::isfinite(box.min[k]) || !std::isfinite(box.max[k]))
            return invalid(path + ".box", "corners must be finite", "give lengths in m");
        if (!(box.min[k] < box.max[k]))
            return invalid(path + ".box.max[" + std::to_string(k) + "]", "must be greater than min on each axis",
                           "swap the corners, or give the box an extent");
    }
    return Done{};
}

Status check(const proto::SphereDesc& sphere, int dimensions, const std::string& path) {
    if (!is_finite(sphere.center, dimensions))
        return invalid(path + ".sphere.center", "must be finite", "give lengths in m");
    if (!(std::isfinite(sphere.radius) && sphere.radius > 0.0))
        return invalid(path + ".sphere.radius", "must be greater than 0 m", "give a radius in m");
    return Done{};
}

Status check(const proto::CylinderDesc& cylinder, int dimensions, const std::string& path) {
    if (dimensions == 2) return invalid(path + ".cylinder", "is for 3 dimensions only", "in 2D a disc is a sphere");
    if (!is_finite(cylinder.from, 3) || !is_finite(cylinder.to, 3))
        return invalid(path + ".cylinder", "both ends must be finite", "give lengths in m");
    if (!(norm(minus(cylinder.to, cylinder.from)) > 0.0))
        return invalid(path + ".cylinder.to", "must differ from `from`", "give the centres of the two flat ends [m]");
    if (!(std::isfinite(cylinder.radius) && cylinder.radius > 0.0))
        return invalid(path + ".cylinder.radius", "must be greater than 0 m", "give a radius in m");
    return Done{};
}

Status check(const proto::PlaneDesc& plane, int dimensions, const std::string& path) {
    if (!is_finite(plane.point, dimensions))
        return invalid(path + ".plane.point", "must be finite", "give lengths in m");
    Vec3 normal = plane.normal;
    if (dimensions == 2) normal[2] = 0.0;
    if (!is_finite(normal, 3) || !(norm(normal) > 0.0))
        return invalid(path + ".plane.normal", "must be finite and not zero", "give a direction, of any length");
    return Done{};
}

Status check_parts(const std::vector<proto::ShapeDesc>& parts, int dimensions, const std::string& path) {
    if (parts.size() < 2) return invalid(path, "must have at least 2 parts", "a single shape stands alone");
    for (std::size_t k = 0; k < parts.size(); ++k)
        if (Status status = validate_shape(parts[k], dimensions, path + "[" + std::to_string(k) + "]"); !status)
            return status;
    return Done{};
}

Status check(const proto::DifferenceDesc& difference, int dimensions, const std::string& path) {
    return check_parts(difference.of, dimensions, path + ".difference.of");
}

Status check(const proto::IntersectionDesc& intersection, int dimensions, const std::string& path) {
    return check_parts(intersection.of, dimensions, path + ".intersection.of");
}

}  // namespace

Status validate_shape(const proto::ShapeDesc& shape, int dimensions, const std::string& path) {
    return std::visit([&](const auto& kind) { return check(kind, dimensions, path); }, shape);
}

Status validate_object(const proto::ObjectDesc& object, int dimensions, const std::string& path) {
    if (object.name.empty()) return invalid(path + ".name", "is empty", "name the object");
    if (std::holds_alternative<proto::DifferenceDesc>(object.shape) ||
        std::holds_alternative<proto::IntersectionDesc>(object.shape))
        return invalid(path + ".shape", "must be a box, a sphere, a cylinder or a plane",
                       "give each part an object of its own; differences and intersections are for fluids");
    return validate_shape(object.shape, dimensions, path + ".shape");
}

}  // namespace headrace::scene
