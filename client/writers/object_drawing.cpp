#include "client/writers/object_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "client/writers/block_faces.h"
#include "client/writers/boxes.h"

namespace headrace::client {

namespace {

using proto::BoxDesc;
using proto::ObjectRole;
using proto::SphereDesc;

// Chosen by looking: glass is a cool grey, obstacles a warm one that the palette does not hold.
constexpr Rgb kGlass{0x6F, 0x86, 0x9C}, kGlassEdge{0x4A, 0x5B, 0x6C};
constexpr Rgb kSolid{0xD9, 0x8C, 0x5F}, kSolidEdge{0x8A, 0x4B, 0x2A};
constexpr double kEdgeWidth = 1.3;  // [px]

bool faces_viewer(const Camera& camera, const Block& block, const Face& face) {
    return dot(normal_of(block, face), camera.towards_eye(block.corners[face.corners[0]])) > 0;
}

// Draws the faces on one side of the block as `alpha(normal)` says.
template <class Alpha>
void draw_faces(Raster& raster, const OpenBlock& shown, bool near_side, Rgb color, const Alpha& alpha) {
    for (const Face& face : kFaces) {
        if (!shown.has(face) || faces_viewer(raster.camera(), shown.block, face) != near_side) continue;
        std::array<Vec3, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = shown.block.corners[face.corners[k]];
        raster.polygon(corners, color, alpha(normal_of(shown.block, face)));
    }
}

// An edge is on the near side when one of its two faces is.
void draw_edges(Raster& raster, const OpenBlock& shown, bool near_side, Rgb color, double alpha) {
    const Block& block = shown.block;
    for (const Edge& edge : block_edges()) {
        const bool is_near = faces_viewer(raster.camera(), block, *edge.faces[0]) ||
                             faces_viewer(raster.camera(), block, *edge.faces[1]);
        if (is_near == near_side && shown.has(edge))
            raster.line(block.corners[edge.from], block.corners[edge.to], kEdgeWidth, color, alpha);
    }
}

// Circles on a sphere about each of the three axes; only the part on the near (or far) side.
void draw_circles(Raster& raster, const SphereDesc& sphere, bool near_side, double alpha) {
    constexpr int kPieces = 180;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = [&](int k) {
            const double angle = 2 * std::numbers::pi * k / kPieces;
            Vec3 normal{};
            normal[(axis + 1) % 3] = std::cos(angle), normal[(axis + 2) % 3] = std::sin(angle);
            return normal;
        };
        for (int k = 0; k < kPieces; ++k) {
            const Vec3 a = sphere.center + sphere.radius * at(k), b = sphere.center + sphere.radius * at(k + 1);
            const bool is_near = dot(at(k), raster.camera().towards_eye(a)) > 0;
            if (is_near == near_side) raster.line(a, b, 1.0, kGlassEdge, alpha);
        }
    }
}

// Glass is seen where one looks along it: towards the rim.
void draw_glass_sphere(Raster& raster, const SphereDesc& sphere, bool near_side) {
    raster.sphere(sphere.center, sphere.radius, near_side ? Raster::Half::near : Raster::Half::far,
                  [near_side](const Vec3&, double facing) -> Raster::Tint {
                      const double grazing = 1 - facing, second = grazing * grazing, fourth = second * second;
                      return {kGlassEdge, near_side ? 0.02 + 0.45 * fourth * fourth : 0.08 + 0.25 * fourth};
                  });
    draw_circles(raster, sphere, near_side, near_side ? 0.30 : 0.35);
}

Rgb scaled(Rgb color, double light) {
    const auto scale = [light](std::uint8_t c) { return static_cast<std::uint8_t>(std::clamp(c * light, 0.0, 255.0)); };
    return {scale(color.r), scale(color.g), scale(color.b)};
}

void draw_solid_sphere(Raster& raster, const SphereDesc& sphere) {
    const Camera& camera = raster.camera();
    const Vec3 light = normalized(-0.35 * camera.right() + 0.6 * camera.up() + 0.72 * camera.backward());
    raster.sphere(sphere.center, sphere.radius, Raster::Half::near,
                  [&](const Vec3& normal, double facing) -> Raster::Tint {
                      const double lit = 0.62 + 0.45 * std::max(0.0, dot(normal, light));
                      return {scaled(kSolid, lit), 0.78 + 0.2 * (1 - facing) * (1 - facing)};
                  });
}

void draw_solid_box(Raster& raster, const OpenBlock& box) {
    draw_faces(raster, box, false, kSolid, [](const Vec3&) { return 0.20; });
    draw_edges(raster, box, false, kSolidEdge, 0.35);
    const Vec3 up = raster.camera().up();
    draw_faces(raster, box, true, kSolid, [&](const Vec3& normal) { return 0.34 - 0.10 * dot(normal, up); });
    draw_edges(raster, box, true, kSolidEdge, 0.85);
}

// Facets of the mantle and the two ends on one side, with the rims.
void draw_cylinder(Raster& raster, const proto::CylinderDesc& cylinder, bool near_side, Rgb color, Rgb edge,
                   double alpha) {
    constexpr int kFacets = 60;
    const Vec3 axis = normalized(cylinder.to - cylinder.from);
    const auto [side, front] = perpendiculars(axis);
    const auto normal_at = [&, side = side, front = front](double k) {
        const double angle = 2 * std::numbers::pi * k / kFacets;
        return std::cos(angle) * side + std::sin(angle) * front;
    };
    const auto is_seen = [&](const Vec3& normal, const Vec3& at) {
        return (dot(normal, raster.camera().towards_eye(at)) > 0) == near_side;
    };
    for (int k = 0; k < kFacets; ++k) {
        const Vec3 a = cylinder.radius * normal_at(k), b = cylinder.radius * normal_at(k + 1);
        const std::array<Vec3, 4> facet{cylinder.from + a, cylinder.from + b, cylinder.to + b, cylinder.to + a};
        if (is_seen(normal_at(k + 0.5), facet[0])) raster.polygon(facet, color, alpha);
    }
    for (const bool is_end : {false, true}) {
        const Vec3& center = is_end ? cylinder.to : cylinder.from;
        if (!is_seen((is_end ? 1.0 : -1.0) * axis, center)) continue;
        const std::vector<Vec3> rim = circle(center, cylinder.radius, axis, kFacets);
        raster.polygon(rim, color, alpha);
        for (int k = 0; k < kFacets; ++k) raster.line(rim[k], rim[(k + 1) % kFacets], kEdgeWidth, edge, 0.7);
    }
}

void draw_container(Raster& raster, const PlacedObject& object, bool near_side, const Stage& stage) {
    const PlacedShape shape = placed_shape(object);
    if (const auto* sphere = std::get_if<SphereDesc>(&shape)) return draw_glass_sphere(raster, *sphere, near_side);
    if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&shape))
        return draw_cylinder(raster, *cylinder, near_side, kGlass, kGlassEdge, near_side ? 0.03 : 0.12);
    const OpenBlock shown = shown_container(object, stage);
    const Vec3 up = raster.camera().up();
    // The floor a little darker: it carries the scene.
    const auto alpha = [&](const Vec3& normal) {
        if (near_side) return 0.03;
        return dot(normal, up) < -0.5 ? 0.26 : 0.11;
    };
    draw_faces(raster, shown, near_side, kGlass, alpha);
    draw_edges(raster, shown, near_side, kGlassEdge, near_side ? 0.9 : 0.45);
}

// A sheet as large as what is shown.
void draw_plane(Raster& raster, const proto::PlaneDesc& plane, const BoxDesc& shown) {
    const std::vector<Vec3> sheet = plane_in_box(plane, shown);
    if (sheet.size() < 3) return;
    const bool is_behind = dot(plane.normal, raster.camera().towards_eye(sheet[0])) > 0;
    raster.polygon(sheet, kGlass, is_behind ? 0.26 : 0.05);
    for (std::size_t k = 0; k < sheet.size(); ++k)
        raster.line(sheet[k], sheet[(k + 1) % sheet.size()], kEdgeWidth, kGlassEdge, is_behind ? 0.5 : 0.3);
}

// A line, hatched on the side without fluid as drawings of walls are.
void draw_flat_plane(Raster& raster, const proto::PlaneDesc& plane, const BoxDesc& shown, const Vec3& raise) {
    const std::vector<Vec3> ends = plane_in_box(plane, shown);
    if (ends.size() != 2) return;
    const Vec3 from = ends[0] + raise, to = ends[1] + raise;
    raster.line(from, to, 2.0, kGlassEdge, 1.0);
    const double span = length(to - from), step = 0.02 * length(shown.max - shown.min);
    const Vec3 along = (1 / span) * (to - from), stroke = 0.5 * step * (along - normalized(plane.normal));
    for (double s = 0; s + 0.5 * step < span; s += step)
        raster.line(from + s * along, from + s * along + stroke, 1.0, kGlassEdge, 0.8);
}

Vec3 center_of(const PlacedObject& object) {
    const BoxDesc box = placed_bounds(object);
    return 0.5 * (box.min + box.max);
}

}  // namespace

BoxDesc room_of_planes(const Stage& stage) {
    return grown(stage.bounds, 0.04 * length(stage.bounds.max - stage.bounds.min));
}

void draw_objects(Raster& raster, const std::vector<PlacedObject>& objects, const Stage& stage) {
    // Translucent things blend from far to near: planes, far walls, obstacles by distance, near walls.
    std::vector<const PlacedObject*> containers, obstacles;
    for (const PlacedObject& object : objects) {
        if (object.is_plane())
            draw_plane(raster, std::get<proto::PlaneDesc>(placed_shape(object)), room_of_planes(stage));
        else
            (object.is_container() ? containers : obstacles).push_back(&object);
    }
    std::ranges::stable_sort(obstacles, {}, [&](const PlacedObject* object) {
        return raster.camera().project(center_of(*object)).nearness;
    });

    for (const PlacedObject* container : containers) draw_container(raster, *container, false, stage);
    for (const PlacedObject* obstacle : obstacles) {
        const PlacedShape shape = placed_shape(*obstacle);
        if (const auto* sphere = std::get_if<SphereDesc>(&shape))
            draw_solid_sphere(raster, *sphere);
        else if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&shape))
            for (const bool near_side : {false, true})
                draw_cylinder(raster, *cylinder, near_side, kSolid, kSolidEdge, near_side ? 0.4 : 0.2);
        else
            draw_solid_box(raster, shown_obstacle(*obstacle, objects, stage));
    }
    for (const PlacedObject* container : containers) draw_container(raster, *container, true, stage);
}

void draw_flat_objects(Raster& raster, const std::vector<PlacedObject>& objects, const Stage& stage, double lift) {
    const Vec3 raise = lift * raster.camera().backward();
    for (const PlacedObject& object : objects)
        if (object.is_plane()) {
            BoxDesc room = room_of_planes(stage);
            room.min[2] = room.max[2] = 0;
            draw_flat_plane(raster, std::get<proto::PlaneDesc>(placed_shape(object)), room, raise);
        }
    for (const ObjectRole role : {ObjectRole::obstacle, ObjectRole::container})
        for (const PlacedObject& object : objects) {
            if (object.desc.role != role || object.is_plane()) continue;
            std::vector<Vec3> corners;
            const PlacedShape shape = placed_shape(object);
            if (const auto* disc = std::get_if<SphereDesc>(&shape)) {
                corners = circle(disc->center, disc->radius, {0, 0, 1}, 180);
            } else {
                const Block block =
                    role == ObjectRole::obstacle ? visible_block(object, objects) : std::get<Block>(shape);
                for (const std::size_t k : {0, 1, 3, 2}) corners.push_back(block.corners[k]);
            }
            for (Vec3& corner : corners) corner = Vec3{corner[0], corner[1], 0} + raise;
            const bool is_solid = role == ObjectRole::obstacle;
            if (is_solid) raster.polygon(corners, kSolid, 0.75);
            for (std::size_t k = 0; k < corners.size(); ++k)
                raster.line(corners[k], corners[(k + 1) % corners.size()], is_solid ? kEdgeWidth : 2.0,
                            is_solid ? kSolidEdge : kGlassEdge, 1.0);
        }
}

}  // namespace headrace::client
