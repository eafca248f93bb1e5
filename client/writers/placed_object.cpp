#include "client/writers/placed_object.h"

#include <algorithm>
#include <cmath>

#include "client/writers/boxes.h"
#include "proto/shape_bounds.h"

namespace headrace::client {

using proto::BoxDesc;

std::vector<PlacedObject> at_rest(const std::vector<proto::ObjectDesc>& objects) {
    return {objects.begin(), objects.end()};
}

Block::Block(const BoxDesc& box, const scene::Placement& place) : corners{} {
    for (int k = 0; k < 8; ++k) corners[static_cast<std::size_t>(k)] = place(box_corner(box, k));
}

PlacedShape placed_shape(const PlacedObject& object) {
    const scene::Placement& place = object.place;
    if (const auto* sphere = std::get_if<proto::SphereDesc>(&object.desc.shape))
        return proto::SphereDesc{place(sphere->center), sphere->radius};
    if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&object.desc.shape))
        return proto::CylinderDesc{place(cylinder->from), place(cylinder->to), cylinder->radius};
    if (const auto* plane = std::get_if<proto::PlaneDesc>(&object.desc.shape))
        return proto::PlaneDesc{place(plane->point), place.turned(plane->normal)};
    return Block(std::get<BoxDesc>(object.desc.shape), place);
}

BoxDesc placed_bounds(const PlacedObject& object) {
    const PlacedShape shape = placed_shape(object);
    if (const auto* block = std::get_if<Block>(&shape)) return bounds_of(block->corners);
    if (const auto* sphere = std::get_if<proto::SphereDesc>(&shape)) return proto::bounding_box(*sphere);
    return proto::bounding_box(std::get<proto::CylinderDesc>(shape));
}

BoxDesc container_bounds(const std::vector<PlacedObject>& objects) {
    BoxDesc bounds = kNowhere;
    for (const PlacedObject& object : objects)
        if (object.is_container() && !object.is_plane()) include(bounds, placed_bounds(object));
    return bounds;
}

Block visible_block(const PlacedObject& obstacle, const std::vector<PlacedObject>& objects) {
    const Block whole(std::get<BoxDesc>(obstacle.desc.shape), obstacle.place);
    if (obstacle.place.is_turned()) return whole;
    return Block(common_part(bounds_of(whole.corners), container_bounds(objects)));
}

std::vector<Vec3> plane_in_box(const proto::PlaneDesc& plane, const BoxDesc& box) {
    const Vec3 normal = normalized(plane.normal);
    std::vector<Vec3> cuts;
    for (int from = 0; from < 8; ++from)
        for (const int axis : {1, 2, 4}) {
            if ((from & axis) != 0) continue;
            const Vec3 a = box_corner(box, from), b = box_corner(box, from | axis);
            const double above = dot(a - plane.point, normal), below = dot(b - plane.point, normal);
            if (a == b || (above > 0) == (below > 0)) continue;
            const Vec3 cut = a + (above / (above - below)) * (b - a);
            const double near = 1e-9 * length(box.max - box.min);
            if (std::ranges::none_of(cuts, [&](const Vec3& other) { return length(other - cut) < near; }))
                cuts.push_back(cut);
        }
    if (cuts.size() < 3) return cuts;
    // In order about their middle.
    Vec3 middle{};
    for (const Vec3& cut : cuts) middle = middle + (1.0 / static_cast<double>(cuts.size())) * cut;
    const auto [side, front] = perpendiculars(normal);
    const auto angle = [&, side = side, front = front](const Vec3& cut) {
        return std::atan2(dot(cut - middle, front), dot(cut - middle, side));
    };
    std::ranges::sort(cuts, {}, angle);
    return cuts;
}

}  // namespace headrace::client
