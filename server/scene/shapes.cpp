#include "server/scene/shapes.h"

namespace headrace::scene {

namespace {

bool box_contains(const proto::BoxDesc& box, const proto::Vec3& x, int dimensions, double margin) {
    for (int k = 0; k < dimensions; ++k)
        if (x[k] < box.min[k] - margin || x[k] > box.max[k] + margin) return false;
    return true;
}

bool sphere_contains(const proto::SphereDesc& sphere, const proto::Vec3& x, int dimensions, double margin) {
    double distance_squared = 0.0;
    for (int k = 0; k < dimensions; ++k) distance_squared += (x[k] - sphere.center[k]) * (x[k] - sphere.center[k]);
    const double reach = sphere.radius + margin;
    return reach >= 0.0 && distance_squared <= reach * reach;
}

}  // namespace

proto::BoxDesc bounding_box(const proto::ShapeDesc& shape) {
    if (const auto* box = std::get_if<proto::BoxDesc>(&shape)) return *box;
    const auto& sphere = std::get<proto::SphereDesc>(shape);
    proto::BoxDesc bounds;
    for (int k = 0; k < 3; ++k) {
        bounds.min[k] = sphere.center[k] - sphere.radius;
        bounds.max[k] = sphere.center[k] + sphere.radius;
    }
    return bounds;
}

proto::Vec3 center_of(const proto::ShapeDesc& shape) {
    if (const auto* sphere = std::get_if<proto::SphereDesc>(&shape)) return sphere->center;
    const auto& box = std::get<proto::BoxDesc>(shape);
    proto::Vec3 center;
    for (int k = 0; k < 3; ++k) center[k] = 0.5 * (box.min[k] + box.max[k]);
    return center;
}

proto::ShapeDesc moved_by(const proto::ShapeDesc& shape, const proto::Vec3& displacement) {
    proto::ShapeDesc moved = shape;
    for (int k = 0; k < 3; ++k) {
        if (auto* box = std::get_if<proto::BoxDesc>(&moved)) {
            box->min[k] += displacement[k];
            box->max[k] += displacement[k];
        } else {
            std::get<proto::SphereDesc>(moved).center[k] += displacement[k];
        }
    }
    return moved;
}

bool contains(const proto::ShapeDesc& shape, const proto::Vec3& x, int dimensions, double margin) {
    if (const auto* box = std::get_if<proto::BoxDesc>(&shape)) return box_contains(*box, x, dimensions, margin);
    return sphere_contains(std::get<proto::SphereDesc>(shape), x, dimensions, margin);
}

solver::CollisionObject to_collision_object(const proto::ObjectDesc& object, int dimensions) {
    solver::CollisionObject collision;
    collision.name = object.name;
    collision.role = object.role == proto::ObjectRole::container ? solver::Role::container : solver::Role::obstacle;
    if (const auto* sphere = std::get_if<proto::SphereDesc>(&object.shape)) {
        solver::Sphere primitive{sphere->center, sphere->radius};
        if (dimensions == 2) primitive.center[2] = 0.0;
        collision.shape = primitive;
        return collision;
    }
    const auto& box = std::get<proto::BoxDesc>(object.shape);
    solver::Box primitive;
    for (int k = 0; k < dimensions; ++k) {
        primitive.center[k] = 0.5 * (box.min[k] + box.max[k]);
        primitive.half_extent[k] = 0.5 * (box.max[k] - box.min[k]);
    }
    collision.shape = primitive;
    return collision;
}

}  // namespace headrace::scene
