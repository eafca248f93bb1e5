#include "server/scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/scene/vectors.h"

namespace headrace::scene {

namespace {

using proto::BoxDesc;
using proto::CylinderDesc;
using proto::DifferenceDesc;
using proto::IntersectionDesc;
using proto::PlaneDesc;
using proto::SphereDesc;
using proto::Vec3;

// ---- insides ----

bool holds(const BoxDesc& box, const Vec3& x, int dimensions, double margin) {
    for (int k = 0; k < dimensions; ++k)
        if (x[k] < box.min[k] - margin || x[k] > box.max[k] + margin) return false;
    return true;
}

bool holds(const SphereDesc& sphere, const Vec3& x, int dimensions, double margin) {
    double distance_squared = 0.0;
    for (int k = 0; k < dimensions; ++k) distance_squared += (x[k] - sphere.center[k]) * (x[k] - sphere.center[k]);
    const double reach = sphere.radius + margin;
    return reach >= 0.0 && distance_squared <= reach * reach;
}

bool holds(const CylinderDesc& cylinder, const Vec3& x, int, double margin) {
    const Vec3 axis = normalized(minus(cylinder.to, cylinder.from));
    const double along = dot(minus(x, cylinder.from), axis);
    const double length = norm(minus(cylinder.to, cylinder.from));
    const double aside = norm(minus(x, plus(cylinder.from, scaled(along, axis))));
    return along >= -margin && along <= length + margin && aside <= cylinder.radius + margin;
}

bool holds(const PlaneDesc& plane, const Vec3& x, int dimensions, double margin) {
    double height = 0.0;
    for (int k = 0; k < dimensions; ++k) height += (x[k] - plane.point[k]) * plane.normal[k];
    return height <= margin * norm(plane.normal);
}

bool holds(const DifferenceDesc& difference, const Vec3& x, int dimensions, double margin) {
    for (std::size_t k = 0; k < difference.of.size(); ++k)
        if (contains(difference.of[k], x, dimensions, k == 0 ? margin : -margin) != (k == 0)) return false;
    return true;
}

bool holds(const IntersectionDesc& intersection, const Vec3& x, int dimensions, double margin) {
    return std::ranges::all_of(intersection.of,
                               [&](const proto::ShapeDesc& part) { return contains(part, x, dimensions, margin); });
}

// ---- moves ----

void move(BoxDesc& box, const Vec3& by) {
    box.min = plus(box.min, by);
    box.max = plus(box.max, by);
}

void move(SphereDesc& sphere, const Vec3& by) {
    sphere.center = plus(sphere.center, by);
}

void move(CylinderDesc& cylinder, const Vec3& by) {
    cylinder.from = plus(cylinder.from, by);
    cylinder.to = plus(cylinder.to, by);
}

void move(PlaneDesc& plane, const Vec3& by) {
    plane.point = plus(plane.point, by);
}

void move(DifferenceDesc& difference, const Vec3& by) {
    for (proto::ShapeDesc& part : difference.of) part = moved_by(part, by);
}

void move(IntersectionDesc& intersection, const Vec3& by) {
    for (proto::ShapeDesc& part : intersection.of) part = moved_by(part, by);
}

// ---- heights ----

double height_of(const BoxDesc& box, const Vec3& up, int dimensions) {
    double height = 0.0;
    for (int k = 0; k < dimensions; ++k) height += std::max(up[k] * box.min[k], up[k] * box.max[k]);
    return height;
}

double height_of(const SphereDesc& sphere, const Vec3& up, int dimensions) {
    double height = sphere.radius;
    for (int k = 0; k < dimensions; ++k) height += up[k] * sphere.center[k];
    return height;
}

double height_of(const CylinderDesc& cylinder, const Vec3& up, int) {
    const double along = dot(normalized(minus(cylinder.to, cylinder.from)), up);
    return std::max(dot(cylinder.from, up), dot(cylinder.to, up)) +
           cylinder.radius * std::sqrt(std::max(0.0, 1.0 - along * along));
}

double height_of(const PlaneDesc& plane, const Vec3& up, int) {
    const double cosine = dot(plane.normal, up) / norm(plane.normal);
    constexpr double kSquare = 1.0 - 1e-12;  // a plane across `up` is a lid, any other has no highest point
    return cosine >= kSquare ? dot(plane.point, up) : std::numeric_limits<double>::infinity();
}

double height_of(const DifferenceDesc& difference, const Vec3& up, int dimensions) {
    return highest_point(difference.of.front(), up, dimensions);
}

double height_of(const IntersectionDesc& intersection, const Vec3& up, int dimensions) {
    double height = std::numeric_limits<double>::infinity();
    for (const proto::ShapeDesc& part : intersection.of) height = std::min(height, highest_point(part, up, dimensions));
    return height;
}

// ---- primitives ----

// What lies along the third axis is 0 in 2D.
Vec3 flattened(Vec3 x, int dimensions) {
    if (dimensions == 2) x[2] = 0.0;
    return x;
}

struct PrimitiveOf {
    int dimensions;

    solver::Primitive operator()(const BoxDesc& box) const {
        solver::Box primitive;
        for (int k = 0; k < dimensions; ++k) {
            primitive.center[k] = 0.5 * (box.min[k] + box.max[k]);
            primitive.half_extent[k] = 0.5 * (box.max[k] - box.min[k]);
        }
        return primitive;
    }
    solver::Primitive operator()(const SphereDesc& sphere) const {
        return solver::Sphere{flattened(sphere.center, dimensions), sphere.radius};
    }
    solver::Primitive operator()(const CylinderDesc& cylinder) const {
        const Vec3 along = minus(cylinder.to, cylinder.from);
        return solver::Cylinder{scaled(0.5, plus(cylinder.from, cylinder.to)), normalized(along), cylinder.radius,
                                0.5 * norm(along)};
    }
    solver::Primitive operator()(const PlaneDesc& plane) const {
        return solver::Plane{flattened(plane.point, dimensions), normalized(flattened(plane.normal, dimensions))};
    }
    // Objects have none of these: validate_object refuses them.
    solver::Primitive operator()(const DifferenceDesc&) const { return {}; }
    solver::Primitive operator()(const IntersectionDesc&) const { return {}; }
};

}  // namespace

proto::Vec3 center_of(const proto::ShapeDesc& shape) {
    if (const auto* sphere = std::get_if<SphereDesc>(&shape)) return sphere->center;
    if (const auto* plane = std::get_if<PlaneDesc>(&shape)) return plane->point;
    const BoxDesc box = bounding_box(shape);
    return scaled(0.5, plus(box.min, box.max));
}

proto::ShapeDesc moved_by(const proto::ShapeDesc& shape, const Vec3& displacement) {
    proto::ShapeDesc moved = shape;
    std::visit([&](auto& kind) { move(kind, displacement); }, moved);
    return moved;
}

bool contains(const proto::ShapeDesc& shape, const Vec3& x, int dimensions, double margin) {
    return std::visit([&](const auto& kind) { return holds(kind, x, dimensions, margin); }, shape);
}

double highest_point(const proto::ShapeDesc& shape, const Vec3& up, int dimensions) {
    return std::visit([&](const auto& kind) { return height_of(kind, up, dimensions); }, shape);
}

solver::Primitive to_primitive(const proto::ShapeDesc& shape, int dimensions) {
    return std::visit(PrimitiveOf{dimensions}, shape);
}

}  // namespace headrace::scene
