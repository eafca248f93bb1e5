// Scenes for POV-Ray 3.7: one <stem>_000123.pov per frame. Particles are spheres of the radius of Staubach 2010,
// Eq. 3.5, coloured by the palette; containers are glass, obstacles solid; camera as in the pictures, one light. Render
// with `povray wave_000123.pov +W1280 +H720 +A`.
#include <algorithm>
#include <cmath>

#include "client/writers/exact_text.h"
#include "client/writers/file_output.h"
#include "client/writers/formats.h"
#include "client/writers/scene_view.h"

namespace headrace::client {

namespace {

constexpr std::size_t kShades = 256;

void append_short(std::string& text, double number) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6);
    text.append(digits, end.ptr);
}

std::string number(double value) {
    std::string text;
    append_short(text, value);
    return text;
}

std::string vector(const Vec3& x) {
    return "<" + number(x[0]) + "," + number(x[1]) + "," + number(x[2]) + ">";
}

// What POV-Ray makes of a shape; flat scenes are `depth` [m] deep.
struct Geometry {
    int dimensions;
    double depth;

    Vec3 lifted(const Vec3& x, double z) const { return dimensions == 2 ? Vec3{x[0], x[1], z} : x; }
    std::string operator()(const proto::BoxDesc& box) const {
        return "box { " + vector(lifted(box.min, -depth / 2)) + ", " + vector(lifted(box.max, depth / 2));
    }
    std::string operator()(const proto::SphereDesc& sphere) const {
        if (dimensions == 2)
            return "cylinder { " + vector(lifted(sphere.center, -depth / 2)) + ", " +
                   vector(lifted(sphere.center, depth / 2)) + ", " + number(sphere.radius);
        return "sphere { " + vector(sphere.center) + ", " + number(sphere.radius);
    }
    std::string operator()(const proto::CylinderDesc& cylinder) const {
        return "cylinder { " + vector(cylinder.from) + ", " + vector(cylinder.to) + ", " + number(cylinder.radius);
    }
    std::string operator()(const proto::PlaneDesc& plane) const {
        const Vec3 normal = normalized(plane.normal);
        return "plane { " + vector(normal) + ", " + number(dot(normal, plane.point));
    }
    template <class Combination>
    std::string operator()(const Combination&) const {
        return "union {";  // objects are never combined shapes
    }
};

// The edges of a box as thin rods: glass alone can hardly be seen.
std::string edges_text(const proto::BoxDesc& box, double radius) {
    std::string text;
    for (int from = 0; from < 8; ++from)
        for (const int axis : {1, 2, 4}) {
            if ((from & axis) != 0 || box_corner(box, from) == box_corner(box, from | axis)) continue;
            text += "cylinder { " + vector(box_corner(box, from)) + ", " + vector(box_corner(box, from | axis)) + ", " +
                    number(radius) + " texture { Edge } no_shadow }\n";
        }
    return text;
}

class PovWriter final : public Writer {
  public:
    explicit PovWriter(const WriterOptions& options)
        : options_(options),
          colors_(make_color_scale(options.scene, options.picture)),
          radius_(particle_radius(options.scene)),
          size_(length(visible_bounds(options.scene).max - visible_bounds(options.scene).min)),
          head_(make_head()) {}

    proto::Result<InOrder> prepare(const FrameTask& task) override {
        const proto::FrameView& frame = task.frame;
        for (const proto::Field field : {proto::Field::position, colors_.field})
            if (frame.find(field) == nullptr)
                return proto::Error{proto::ErrorCode::invalid_params,
                                    "the frames hold no field `" + std::string(proto::field_info(field).name) + "`",
                                    "fields", "record with it, or choose another colour"};
        const std::vector<Vec3> positions = particle_positions(frame);
        const std::vector<float> values = color_values(frame, colors_.field);
        std::string text =
            "// t = " + number(frame.info.time) + " s, step " + std::to_string(frame.info.step) + "\n" + head_;
        text.reserve(text.size() + 64 * positions.size());
        for (std::size_t k = 0; k < positions.size(); ++k) {
            if (!std::isfinite(positions[k][0] + positions[k][1] + positions[k][2])) continue;
            const double t = (values[k] - colors_.min) / (colors_.max - colors_.min);
            const double shade = std::isnan(t) ? kShades : std::round(std::clamp(t, 0.0, 1.0) * (kShades - 1));
            text += "sphere{<";
            for (int axis = 0; axis < 3; ++axis) {
                if (axis > 0) text += ',';
                append_short(text, positions[k][axis]);
            }
            text += ">,R texture{T[" + std::to_string(static_cast<int>(shade)) + "]}}\n";
        }
        text += objects_text(task.objects, frame.info.dimensions);
        const std::string name = numbered_name(options_.stem, task.number, "pov");
        if (auto done = write_file(options_.folder / name, {as_bytes(text)}); !done) return done.error();
        return InOrder([this] {
            ++frames_;
            return proto::Status(proto::Done{});
        });
    }

    proto::Status finish() override { return proto::Done{}; }

    std::string summary() const override {
        return std::to_string(frames_) + " scenes " + (options_.folder / (options_.stem + "_*.pov")).string() +
               ", for povray";
    }

  private:
    std::string objects_text(const std::vector<proto::ObjectDesc>& objects, int dimensions) const {
        std::string text;
        const Geometry geometry{dimensions, 4 * radius_};
        for (const proto::ObjectDesc& object : objects) {
            const bool is_container = object.role == proto::ObjectRole::container;
            // Planes have no end: they would hide the sky, or all.
            if (std::holds_alternative<proto::PlaneDesc>(object.shape)) continue;
            const auto* box = std::get_if<proto::BoxDesc>(&object.shape);
            const proto::ShapeDesc shape =
                box != nullptr && !is_container ? proto::ShapeDesc(inside_containers(*box, objects)) : object.shape;
            text += "// " + object.name + "\n" +
                    std::visit(geometry, static_cast<const proto::ShapeDesc::variant&>(shape)) +
                    (is_container ? " hollow material { Glass } no_shadow }\n" : " texture { Solid } }\n");
            if (box != nullptr && is_container) text += edges_text(*box, 0.12 * radius_ + 0.001 * size_);
        }
        return text;
    }

    // All but particles and objects. A right-handed camera: `right` points to the left in POV-Ray's left-handed space.
    std::string make_head() const {
        const PictureOptions& picture = options_.picture;
        const double aspect = static_cast<double>(picture.width) / picture.height;
        const std::vector<Vec3> outline = visible_outline(options_.scene);
        const Camera camera = make_camera(options_.scene, picture.view, {0, 0, 1, 1});
        const proto::BoxDesc bounds = visible_bounds(options_.scene);
        const Vec3 target = picture.view.target.value_or(0.5 * (bounds.min + bounds.max));
        const Vec3 eye = camera.is_perspective() ? camera.eye() : target + (2 * size_) * camera.backward();

        // Half the picture's width, at distance 1 in perspective: all of the outline, and a margin.
        double half_width = 0;
        for (const Vec3& point : outline) {
            const Vec3 offset = point - eye;
            const double depth = camera.is_perspective() ? -dot(offset, camera.backward()) : 1;
            half_width = std::max({half_width, std::abs(dot(offset, camera.right())) / depth,
                                   aspect * std::abs(dot(offset, camera.up())) / depth});
        }
        half_width *= 1.06;
        const Vec3 right = (camera.is_perspective() ? 1.0 : 2 * half_width) * camera.right();
        const Vec3 up = (camera.is_perspective() ? 1 / aspect : 2 * half_width / aspect) * camera.up();
        const double pull = camera.is_perspective() ? 1 / (2 * half_width) : 1;
        std::string text = "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level 12 }\n";
        text += "background { rgb 1 }\ncamera {\n  " +
                std::string(camera.is_perspective() ? "perspective" : "orthographic") + "\n  location " + vector(eye) +
                "\n  right " + vector(right) + "\n  up " + vector(up) + "\n  direction " +
                vector(-pull * camera.backward()) + "\n}\n";
        const Vec3 light = target + size_ * (2.5 * camera.up() + 2.5 * camera.backward() + -1.5 * camera.right());
        text += "light_source { " + vector(light) + " rgb 0.85 area_light " + vector((0.6 * size_) * camera.right()) +
                ", " + vector((0.6 * size_) * camera.up()) + ", 3, 3 adaptive 1 jitter }\n";
        text += "light_source { " + vector(eye) + " rgb 0.25 shadowless }\n";
        text +=
            "#declare Glass = material { texture { pigment { rgbt <0.72, 0.80, 0.88, 0.90> } finish { ambient 0 "
            "diffuse "
            "0.05 specular 0.4 roughness 0.005 reflection { 0.01, 0.12 } } } interior { ior 1.0 } }\n"
            "#declare Edge = texture { pigment { srgb <0.29, 0.36, 0.42> } finish { ambient 0.4 diffuse 0.5 } }\n"
            "#declare Solid = texture { pigment { srgbt <0.85, 0.55, 0.37, 0.45> } finish { ambient 0.15 diffuse 0.7 "
            "specular "
            "0.15 } }\n";
        // Staubach 2010, Eq. 3.5: cbrt(3 m / (4 pi rho0)); in 2D the disc of the particle's area.
        text += "#declare R = " + number(radius_) + ";\n#declare T = array[" + std::to_string(kShades + 1) + "];\n";
        for (std::size_t k = 0; k <= kShades; ++k) {
            const Rgb c =
                k == kShades ? kNotANumber : palette_color(static_cast<double>(k) / (kShades - 1), colors_.palette);
            text += "#declare T[" + std::to_string(k) + "] = texture { pigment { srgb " +
                    vector({c.r / 255.0, c.g / 255.0, c.b / 255.0}) +
                    " } finish { ambient 0.15 diffuse 0.75 specular 0.25 roughness 0.05 } }\n";
        }
        return text;
    }

    WriterOptions options_;
    ColorScale colors_;
    double radius_;  // [m] of a particle
    double size_;    // [m] of what is to be seen, from corner to corner
    std::string head_;
    std::size_t frames_{0};
};

}  // namespace

std::unique_ptr<Writer> make_pov_writer(const WriterOptions& options) {
    return std::make_unique<PovWriter>(options);
}

}  // namespace headrace::client
