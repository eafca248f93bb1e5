#include "client/writers/pov_scene.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "client/writers/block_faces.h"
#include "client/writers/object_drawing.h"

namespace headrace::client {

namespace {

using proto::BoxDesc;

void append_short(std::string& text, double number) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6);
    text.append(digits, end.ptr);
}

std::string vector(const Vec3& x) {
    return "<" + pov_number(x[0]) + "," + pov_number(x[1]) + "," + pov_number(x[2]) + ">";
}

std::string rod(const Vec3& from, const Vec3& to, double radius) {
    if (from == to) return {};
    return "cylinder { " + vector(from) + ", " + vector(to) + ", " + pov_number(radius) +
           " texture { Edge } no_shadow }\n";
}

std::string sheet(const std::vector<Vec3>& corners, const std::string& look) {
    std::string text = "polygon { " + std::to_string(corners.size() + 1);
    for (const Vec3& corner : corners) text += ", " + vector(corner);
    return text + ", " + vector(corners.front()) + " " + look + " }\n";
}

// A closed line of thin rods: glass alone can hardly be seen.
std::string outline(const std::vector<Vec3>& corners, double radius) {
    std::string text;
    for (std::size_t k = 0; k < corners.size(); ++k) text += rod(corners[k], corners[(k + 1) % corners.size()], radius);
    return text;
}

std::vector<Vec3> circle(const Vec3& center, double radius, const Vec3& normal) {
    constexpr int kCorners = 96;
    const auto [side, front] = perpendiculars(normal);
    std::vector<Vec3> corners;
    for (int k = 0; k < kCorners; ++k) {
        const double angle = 2 * std::numbers::pi * k / kCorners;
        corners.push_back(center + radius * (std::cos(angle) * side + std::sin(angle) * front));
    }
    return corners;
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
            if (is_flat_) return outline(circle(sphere->center, sphere->radius, kForward), rod_);
            return "sphere { " + vector(sphere->center) + ", " + pov_number(sphere->radius) +
                   " texture { Bowl } no_shadow }\n";
        }
        if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&shape)) {
            const Vec3 axis = normalized(cylinder->to - cylinder->from);
            std::string text = "cylinder { " + vector(cylinder->from) + ", " + vector(cylinder->to) + ", " +
                               pov_number(cylinder->radius) + " open texture { Bowl } no_shadow }\n";
            for (const Vec3& end : {cylinder->from, cylinder->to})
                text += outline(circle(end, cylinder->radius, axis), rod_);
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
                return "cylinder { " + vector(lifted(sphere->center, -1)) + ", " + vector(lifted(sphere->center, 1)) +
                       ", " + pov_number(sphere->radius) + look;
            return "sphere { " + vector(sphere->center) + ", " + pov_number(sphere->radius) + look;
        }
        if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&shape))
            return "cylinder { " + vector(cylinder->from) + ", " + vector(cylinder->to) + ", " +
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
constexpr const char* kLooks =
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
constexpr const char* kParticleFinish = "finish { ambient 0 emission 0.22 diffuse 0.72 specular 0.22 roughness 0.03 }";

// Half the picture's width, at distance 1 in perspective: all of the outline, and a margin.
double half_width_of(const Stage& stage, const Camera& camera, const Vec3& eye, double aspect) {
    double half_width = 0;
    for (const Vec3& point : stage.outline) {
        const Vec3 offset = point - eye;
        const double depth = camera.is_perspective() ? -dot(offset, camera.backward()) : 1;
        half_width = std::max({half_width, std::abs(dot(offset, camera.right())) / depth,
                               aspect * std::abs(dot(offset, camera.up())) / depth});
    }
    return 1.06 * half_width;
}

// A right-handed camera: `right` points to the left in POV-Ray's left-handed space.
std::string camera_text(const Camera& camera, const Vec3& eye, double half_width, double aspect) {
    const bool is_perspective = camera.is_perspective();
    const Vec3 right = (is_perspective ? 1.0 : 2 * half_width) * camera.right();
    const Vec3 up = (is_perspective ? 1 / aspect : 2 * half_width / aspect) * camera.up();
    const double pull = is_perspective ? 1 / (2 * half_width) : 1;
    return "camera {\n  " + std::string(is_perspective ? "perspective" : "orthographic") + "\n  location " +
           vector(eye) + "\n  right " + vector(right) + "\n  up " + vector(up) + "\n  direction " +
           vector(-pull * camera.backward()) + "\n}\n";
}

// A soft key light from the upper left behind the viewer, a weak one from the eye and one from the right against black
// shadows.
std::string lights_text(const Camera& camera, const Vec3& target, double size) {
    const Vec3 &right = camera.right(), &up = camera.up(), &backward = camera.backward();
    const Vec3 key = target + size * (3.0 * up + 2.6 * backward - 1.7 * right);
    const Vec3 fill = target + size * (0.6 * up + 2.5 * backward + 2.5 * right);
    return "light_source { " + vector(key) + " rgb 0.80 area_light " + vector((0.8 * size) * right) + ", " +
           vector((0.8 * size) * backward) + ", 4, 4 adaptive 1 jitter }\n" + "light_source { " +
           vector(target + (4 * size) * backward) + " rgb 0.28 shadowless }\n" + "light_source { " + vector(fill) +
           " rgb 0.18 shadowless }\n";
}

}  // namespace

std::string pov_number(double value) {
    std::string text;
    append_short(text, value);
    return text;
}

std::string pov_head(const WriterOptions& options, const Stage& stage, const ColorScale& colors) {
    const PictureOptions& picture = options.picture;
    const double aspect = static_cast<double>(picture.width) / picture.height;
    const double size = length(stage.bounds.max - stage.bounds.min);
    const Camera camera = make_camera(options.scene, stage, picture.view, {0, 0, 1, 1});
    const Vec3 target = picture.view.target.value_or(0.5 * (stage.bounds.min + stage.bounds.max));
    const Vec3 eye = camera.is_perspective() ? camera.eye() : target + (2 * size) * camera.backward();
    const double half_width = half_width_of(stage, camera, eye, aspect) / picture.view.zoom;

    std::string text =
        "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level 24 }\nbackground { rgb 1 }\n";
    text += camera_text(camera, eye, half_width, aspect) + lights_text(camera, target, size) + kLooks;
    // Staubach 2010, Eq. 3.5: cbrt(3 m / (4 pi rho0)); in 2D the disc of the particle's area.
    text += "#declare R = " + pov_number(particle_radius(options.scene)) + ";\n#declare T = array[" +
            std::to_string(kPovShades + 1) + "];\n";
    for (int k = 0; k <= kPovShades; ++k) {
        const Rgb c =
            k == kPovShades ? kNotANumber : palette_color(static_cast<double>(k) / (kPovShades - 1), colors.palette);
        text += "#declare T[" + std::to_string(k) + "] = texture { pigment { srgb " +
                vector({c.r / 255.0, c.g / 255.0, c.b / 255.0}) + " } " + kParticleFinish + " }\n";
    }
    return text;
}

void append_pov_particle(std::string& text, const Vec3& center, int shade) {
    text += "sphere{<";
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis > 0) text += ',';
        append_short(text, center[axis]);
    }
    text += ">,R texture{T[" + std::to_string(shade) + "]}}\n";
}

std::string pov_objects(const std::vector<PlacedObject>& objects, const proto::SceneDesc& scene, const Stage& stage,
                        const Camera& camera) {
    const Builder builder(objects, scene, stage, camera);
    std::string text;
    for (const PlacedObject& object : objects) text += builder.text(object);
    return text;
}

}  // namespace headrace::client
