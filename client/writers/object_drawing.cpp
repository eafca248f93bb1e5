#include "client/writers/object_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "client/writers/scene_view.h"
#include "proto/shape_bounds.h"

namespace headrace::client {

namespace {

using proto::BoxDesc;
using proto::ObjectDesc;
using proto::ObjectRole;
using proto::SphereDesc;

// Chosen by looking: glass is a cool grey, obstacles a warm one that the palette does not hold.
constexpr Rgb kGlass{0x6F, 0x86, 0x9C}, kGlassEdge{0x4A, 0x5B, 0x6C};
constexpr Rgb kSolid{0xD9, 0x8C, 0x5F}, kSolidEdge{0x8A, 0x4B, 0x2A};
constexpr double kEdgeWidth = 1.3;  // [px]

// Corners of the faces as box_corner counts them, and each face's outward normal.
struct Face {
    std::array<int, 4> corners;
    Vec3 normal;
};
const std::array<Face, 6> kFaces{{
    {{0, 4, 6, 2}, {-1, 0, 0}},
    {{1, 3, 7, 5}, {1, 0, 0}},
    {{0, 1, 5, 4}, {0, -1, 0}},
    {{2, 6, 7, 3}, {0, 1, 0}},
    {{0, 2, 3, 1}, {0, 0, -1}},
    {{4, 5, 7, 6}, {0, 0, 1}},
}};

bool faces_viewer(const Camera& camera, const BoxDesc& box, const Face& face) {
    return dot(face.normal, camera.towards_eye(box_corner(box, face.corners[0]))) > 0;
}

// Draws the faces on one side of the box as `alpha(normal)` says.
template <class Alpha>
void draw_faces(Raster& raster, const BoxDesc& box, bool near_side, Rgb color, const Alpha& alpha) {
    for (const Face& face : kFaces) {
        if (faces_viewer(raster.camera(), box, face) != near_side) continue;
        std::array<Vec3, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = box_corner(box, face.corners[k]);
        raster.polygon(corners, color, alpha(face.normal));
    }
}

// An edge is on the near side when one of its two faces is.
void draw_edges(Raster& raster, const BoxDesc& box, bool near_side, Rgb color, double alpha) {
    for (int from = 0; from < 8; ++from)
        for (const int axis : {1, 2, 4}) {
            const int to = from | axis;
            if (to == from) continue;
            bool is_near = false;
            for (const Face& face : kFaces) {
                const auto has = [&](int corner) { return std::ranges::count(face.corners, corner) > 0; };
                if (has(from) && has(to) && faces_viewer(raster.camera(), box, face)) is_near = true;
            }
            if (is_near == near_side) raster.line(box_corner(box, from), box_corner(box, to), kEdgeWidth, color, alpha);
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

void draw_solid_box(Raster& raster, const BoxDesc& box) {
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
        std::vector<Vec3> rim;
        for (int k = 0; k < kFacets; ++k) rim.push_back(center + cylinder.radius * normal_at(k));
        raster.polygon(rim, color, alpha);
        for (int k = 0; k < kFacets; ++k) raster.line(rim[k], rim[(k + 1) % kFacets], kEdgeWidth, edge, 0.7);
    }
}

void draw_container(Raster& raster, const ObjectDesc& object, bool near_side) {
    if (const auto* sphere = std::get_if<SphereDesc>(&object.shape))
        return draw_glass_sphere(raster, *sphere, near_side);
    if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&object.shape))
        return draw_cylinder(raster, *cylinder, near_side, kGlass, kGlassEdge, near_side ? 0.03 : 0.12);
    const auto& box = std::get<BoxDesc>(object.shape);
    const Vec3 up = raster.camera().up();
    // The floor a little darker: it carries the scene.
    draw_faces(raster, box, near_side, kGlass, [&](const Vec3& normal) {
        if (near_side) return 0.03;
        return dot(normal, up) < -0.5 ? 0.26 : 0.11;
    });
    draw_edges(raster, box, near_side, kGlassEdge, near_side ? 0.9 : 0.45);
}

// Planes have no end; where they are, the fluid shows.
bool is_drawn(const ObjectDesc& object) {
    return !std::holds_alternative<proto::PlaneDesc>(object.shape);
}

Vec3 center_of(const ObjectDesc& object) {
    const BoxDesc box = proto::bounding_box(object.shape);
    return 0.5 * (box.min + box.max);
}

}  // namespace

void draw_objects(Raster& raster, const std::vector<ObjectDesc>& objects) {
    // Translucent things blend from far to near: far walls, obstacles by distance, near walls.
    std::vector<const ObjectDesc*> containers, obstacles;
    for (const ObjectDesc& object : objects)
        if (is_drawn(object)) (object.role == ObjectRole::container ? containers : obstacles).push_back(&object);
    std::ranges::stable_sort(
        obstacles, {}, [&](const ObjectDesc* object) { return raster.camera().project(center_of(*object)).nearness; });

    for (const ObjectDesc* container : containers) draw_container(raster, *container, false);
    for (const ObjectDesc* obstacle : obstacles) {
        if (const auto* sphere = std::get_if<SphereDesc>(&obstacle->shape))
            draw_solid_sphere(raster, *sphere);
        else if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&obstacle->shape))
            for (const bool near_side : {false, true})
                draw_cylinder(raster, *cylinder, near_side, kSolid, kSolidEdge, near_side ? 0.4 : 0.2);
        else
            draw_solid_box(raster, inside_containers(std::get<BoxDesc>(obstacle->shape), objects));
    }
    for (const ObjectDesc* container : containers) draw_container(raster, *container, true);
}

void draw_flat_objects(Raster& raster, const std::vector<ObjectDesc>& objects, double lift) {
    const Vec3 raise = lift * raster.camera().backward();
    for (const ObjectRole role : {ObjectRole::obstacle, ObjectRole::container})
        for (const ObjectDesc& object : objects) {
            if (object.role != role || !is_drawn(object)) continue;
            std::vector<Vec3> corners;
            if (const auto* disc = std::get_if<SphereDesc>(&object.shape)) {
                constexpr int kCorners = 180;
                for (int k = 0; k < kCorners; ++k) {
                    const double angle = 2 * std::numbers::pi * k / kCorners;
                    corners.push_back(disc->center +
                                      Vec3{disc->radius * std::cos(angle), disc->radius * std::sin(angle), 0});
                }
            } else {
                BoxDesc box = std::get<BoxDesc>(object.shape);
                if (role == ObjectRole::obstacle) box = inside_containers(box, objects);
                for (const int k : {0, 1, 3, 2}) corners.push_back(box_corner(box, k));
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
