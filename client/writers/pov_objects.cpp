#include "client/writers/pov_objects.h"

#include <array>

#include "client/writers/block_faces.h"
#include "client/writers/object_drawing.h"
#include "client/writers/pov_text.h"
#include "client/writers/scene_view.h"

namespace headrace::client {

namespace {

using proto::BoxDesc;

std::string rod(const Vec3& from, const Vec3& to, double radius) {
    if (from == to) return {};
    return "cylinder { " + pov_vector(from) + ", " + pov_vector(to) + ", " + pov_number(radius) +
           " texture { Edge } no_shadow }\n";
}

std::string sheet(const std::vector<Vec3>& corners, const std::string& look) {
    std::string text = "polygon { " + std::to_string(corners.size() + 1);
    for (const Vec3& corner : corners) text += ", " + pov_vector(corner);
    return text + ", " + pov_vector(corners.front()) + " " + look + " }\n";
}

// A closed line of thin rods: glass alone can hardly be seen.
std::string outline(const std::vector<Vec3>& corners, double radius) {
    std::string text;
    for (std::size_t k = 0; k < corners.size(); ++k) text += rod(corners[k], corners[(k + 1) % corners.size()], radius);
    return text;
}

// Writes the objects of one frame.
class Builder {
  public:
    Builder(const std::vector<PlacedObject>& objects, const proto::SceneDesc& scene, const Stage& stage,
            const Camera& camera)
        : objects_(objects),
          is_flat_(scene.dimensions == 2),
          stage_(stage),
          camera_(camera),
          depth_(2 * particle_radius(scene)),
          rod_(0.0016 * length(stage.bounds.max - stage.bounds.min)) {}

    std::string text(const PlacedObject& object) const {
        const std::string head = "// " + object.desc.name + "\n";
        const PlacedShape shape = placed_shape(object);
        if (const auto* plane = std::get_if<proto::PlaneDesc>(&shape)) return head + plane_text(*plane);
        if (object.is_container()) return head + container_text(object, shape);
        return head + solid_text(object, shape);
    }

  private:
    static constexpr Vec3 kForward{0, 0, 1};
    static constexpr int kCorners = 96;  // of a circle

    // In flat scenes before and behind the particles.
    Vec3 lifted(const Vec3& x, double side) const { return is_flat_ ? Vec3{x[0], x[1], side * depth_} : x; }

    std::string plane_text(const proto::PlaneDesc& plane) const {
        BoxDesc room = room_of_planes(stage_);
        if (is_flat_) room.min[2] = -depth_, room.max[2] = depth_;
        const std::vector<Vec3> corners = plane_in_box(plane, room);
        if (corners.size() < 3) return {};
        return sheet(corners, "texture { Sheet } no_shadow") + outline(corners, 0.6 * rod_);
    }

    std::string container_text(const PlacedObject& object, const PlacedShape& shape) const {
        if (const auto* sphere = std::get_if<proto::SphereDesc>(&shape)) {
            if (is_flat_) return outline(circle(sphere->center, sphere->radius, kForward, kCorners), rod_);
            return "sphere { " + pov_vector(sphere->center) + ", " + pov_number(sphere->radius) +
                   " texture { Bowl } no_shadow }\n";
        }
        if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&shape)) {
            const Vec3 axis = normalized(cylinder->to - cylinder->from);
            std::string text = "cylinder { " + pov_vector(cylinder->from) + ", " + pov_vector(cylinder->to) + ", " +
                               pov_number(cylinder->radius) + " open texture { Bowl } no_shadow }\n";
            for (const Vec3& end : {cylinder->from, cylinder->to})
                text += outline(circle(end, cylinder->radius, axis, kCorners), rod_);
            return text;
        }
        if (is_flat_) return outline(flat_corners(std::get<Block>(shape)), rod_);
        return glass_block(shown_container(object, stage_));
    }

    std::vector<Vec3> flat_corners(const Block& block) const {
        std::vector<Vec3> corners;
        for (const std::size_t k : {0, 1, 3, 2}) corners.push_back(lifted(block.corners[k], 0));
        return corners;
    }

    std::string glass_block(const OpenBlock& shown) const {
        const std::array<Vec3, 8>& corners = shown.block.corners;
        std::string text;
        for (const Face& face : kFaces) {
            if (!shown.has(face)) continue;
            std::vector<Vec3> pane;
            for (const std::size_t corner : face.corners) pane.push_back(corners[corner]);
            const Vec3 normal = normal_of(shown.block, face);
            const bool is_near = dot(normal, camera_.towards_eye(pane.front())) > 0;
            const bool is_floor = dot(normal, camera_.up()) < -0.5;
            text += sheet(pane, std::string("texture { ") +
                                    (is_near    ? "Clear"
                                     : is_floor ? "Floor"
                                                : "Glass") +
                                    " } no_shadow");
        }
        for (const Edge& edge : block_edges())
            if (shown.has(edge)) text += rod(corners[edge.from], corners[edge.to], rod_);
        return text;
    }

    std::string solid_text(const PlacedObject& object, const PlacedShape& shape) const {
        const std::string look = " texture { Solid } }\n";
        if (const auto* sphere = std::get_if<proto::SphereDesc>(&shape)) {
            if (is_flat_)
                return "cylinder { " + pov_vector(lifted(sphere->center, -1)) + ", " +
                       pov_vector(lifted(sphere->center, 1)) + ", " + pov_number(sphere->radius) + look;
            return "sphere { " + pov_vector(sphere->center) + ", " + pov_number(sphere->radius) + look;
        }
        if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&shape))
            return "cylinder { " + pov_vector(cylinder->from) + ", " + pov_vector(cylinder->to) + ", " +
                   pov_number(cylinder->radius) + look;
        Block block = shown_obstacle(object, objects_, stage_).block;
        // A little smaller, so that no face lies in one plane with a tank's.
        const Vec3 middle = 0.5 * (block.corners.front() + block.corners.back());
        for (Vec3& corner : block.corners) corner = corner + 0.002 * (middle - corner);
        if (is_flat_)
            for (std::size_t k = 0; k < 8; ++k) block.corners[k] = lifted(block.corners[k], k < 4 ? -1 : 1);
        // The unit cube in the place of the block: a matrix whose rows are the edges, then a corner.
        std::string matrix;
        for (const int axis : {0, 1, 2})
            for (const double entry : block.edge(axis)) matrix += pov_number(entry) + ",";
        const Vec3& corner = block.corners[0];
        return "box { 0, 1 matrix <" + matrix + pov_number(corner[0]) + "," + pov_number(corner[1]) + "," +
               pov_number(corner[2]) + ">" + look;
    }

    const std::vector<PlacedObject>& objects_;
    bool is_flat_;
    const Stage& stage_;
    const Camera& camera_;
    double depth_;  // [m] of flat scenes, to either side
    double rod_;    // [m] radius of an edge
};

// Chosen by looking. Glass darkens towards its rim, where one looks along it: of round containers nothing else shows
// on white (aoi: 1 where a surface faces the viewer, 0.5 at the rim, 0 where its back does).
constexpr std::string_view kLooks =
    R"(#declare Glass = texture {
  pigment { rgbt <0.62, 0.73, 0.84, 0.84> }
  finish { ambient 0 emission 0.10 diffuse 0.55 specular 0.2 roughness 0.01 }
}
#declare Clear = texture {
  pigment { rgbt <0.62, 0.73, 0.84, 0.97> }
  finish { ambient 0 diffuse 0.5 specular 0.15 roughness 0.01 }
}
#declare Floor = texture {
  pigment { rgbt <0.62, 0.70, 0.78, 0.55> }
  finish { ambient 0 emission 0.15 diffuse 0.55 }
}
#declare Bowl = texture {
  pigment {
    aoi
    color_map {
      [0.00 rgbt <0.62, 0.73, 0.84, 0.82>]
      [0.30 rgbt <0.52, 0.64, 0.76, 0.70>]
      [0.50 rgbt <0.25, 0.34, 0.43, 0.10>]
      [0.62 rgbt <0.45, 0.57, 0.69, 0.80>]
      [1.00 rgbt <0.62, 0.73, 0.84, 0.95>]
    }
  }
  finish { ambient 0 emission 0.10 diffuse 0.55 specular 0.5 roughness 0.003 }
}
#declare Sheet = texture {
  pigment { rgbt <0.70, 0.74, 0.78, 0.35> }
  finish { ambient 0 emission 0.25 diffuse 0.55 }
}
#declare Edge = texture {
  pigment { srgb <0.29, 0.36, 0.42> }
  finish { ambient 0 emission 0.35 diffuse 0.5 }
}
#declare Solid = texture {
  pigment { srgbt <0.87, 0.56, 0.37, 0.48> }
  finish { ambient 0 emission 0.20 diffuse 0.65 specular 0.1 roughness 0.03 }
}
)";

}  // namespace

std::string_view pov_object_looks() {
    return kLooks;
}

std::string pov_objects(const std::vector<PlacedObject>& objects, const proto::SceneDesc& scene, const Stage& stage,
                        const Camera& camera) {
    const Builder builder(objects, scene, stage, camera);
    std::string text;
    for (const PlacedObject& object : objects) text += builder.text(object);
    return text;
}

}  // namespace headrace::client
