// A collision object where it stands at a frame's time.
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "client/writers/vec3.h"
#include "proto/scene_desc.h"
#include "proto/values/motion.h"

namespace headrace::client {

struct PlacedObject {
    proto::ObjectDesc desc;
    scene::Placement place;  // from the description's place to where it is

    PlacedObject(proto::ObjectDesc object, scene::Placement where = {})
        : desc(std::move(object)), place(std::move(where)) {}

    bool is_container() const { return desc.role == proto::ObjectRole::container; }
    bool is_plane() const { return std::holds_alternative<proto::PlaneDesc>(desc.shape); }
};

// Objects at rest, where their descriptions say.
std::vector<PlacedObject> at_rest(const std::vector<proto::ObjectDesc>& objects);

// A box, turned or not: corner k as box_corner counts.
struct Block {
    std::array<Vec3, 8> corners;

    explicit Block(const proto::BoxDesc& box, const scene::Placement& place = {});
    Vec3 edge(int axis) const { return corners[std::size_t{1} << axis] - corners[0]; }  // 2D: no edge along z
};

// The shape where the object is; a box as a block.
using PlacedShape = std::variant<Block, proto::SphereDesc, proto::CylinderDesc, proto::PlaneDesc>;
// Precondition: a shape that objects may have.
PlacedShape placed_shape(const PlacedObject& object);

// [m] Of the shape where the object is. Precondition: no plane.
proto::BoxDesc placed_bounds(const PlacedObject& object);

// [m] What contains: the containers' bounds together; planes have none.
proto::BoxDesc container_bounds(const std::vector<PlacedObject>& objects);

// The part of an obstacle's box that is inside the containers: a panel may reach through walls, which cannot matter.
// Turned ones stay whole, and so do those that are outside altogether.
Block visible_block(const PlacedObject& obstacle, const std::vector<PlacedObject>& objects);

// Where the plane cuts the box: a convex polygon in order; fewer than three corners where it does not. In 2D (a box
// without depth) the two ends of a line.
std::vector<Vec3> plane_in_box(const proto::PlaneDesc& plane, const proto::BoxDesc& box);

}  // namespace headrace::client
