#include "client/writers/pov_scene.h"

#include "client/writers/pov_objects.h"
#include "client/writers/pov_text.h"
#include "client/writers/scene_view.h"

namespace headrace::client {

namespace {

constexpr const char* kParticleFinish = "finish { ambient 0 emission 0.22 diffuse 0.72 specular 0.22 roughness 0.03 }";

// The picture is 1 high, its middle at (0, 0).
double aspect_of(const PictureOptions& picture) {
    return static_cast<double>(picture.width) / picture.height;
}

// The rays through the picture's middle and its edges, in POV-Ray's words. A camera whose middle is aside of where it
// looks (a target moved there) has a `direction` that is not at right angles to `right` and `up`: POV-Ray warns, and
// draws what is meant.
std::string camera_text(const Camera& camera, double aspect, const Vec3& middle, double size) {
    const auto at = [&](double x, double y) {
        const Camera::Ray ray = camera.ray(x, y);
        return camera.is_perspective() ? ray.direction : ray.origin;
    };
    const Camera::Ray axis = camera.ray(0, 0);
    // Orthographic: from before everything.
    const double away = dot(middle, camera.backward()) + 2 * size;
    const Vec3 location = camera.is_perspective() ? camera.eye() : axis.origin + away * camera.backward();
    return "camera {\n  " + std::string(camera.is_perspective() ? "perspective" : "orthographic") + "\n  location " +
           pov_vector(location) + "\n  right " + pov_vector(at(0.5 * aspect, 0) - at(-0.5 * aspect, 0)) + "\n  up " +
           pov_vector(at(0, -0.5) - at(0, 0.5)) + "\n  direction " + pov_vector(axis.direction) + "\n}\n";
}

// About the scene's middle: a soft key light from the upper left behind the viewer, a weak one from the eye and one
// from the right against black shadows.
std::string lights_text(const Camera& camera, const Vec3& middle, double size) {
    const Vec3 &right = camera.right(), &up = camera.up(), &backward = camera.backward();
    const Vec3 key = middle + size * (3.0 * up + 2.6 * backward - 1.7 * right);
    const Vec3 fill = middle + size * (0.6 * up + 2.5 * backward + 2.5 * right);
    return "light_source { " + pov_vector(key) + " rgb 0.80 area_light " + pov_vector((0.8 * size) * right) + ", " +
           pov_vector((0.8 * size) * backward) + ", 4, 4 adaptive 1 jitter }\n" + "light_source { " +
           pov_vector(middle + (4 * size) * backward) + " rgb 0.28 shadowless }\n" + "light_source { " +
           pov_vector(fill) + " rgb 0.18 shadowless }\n";
}

}  // namespace

Camera make_pov_camera(const WriterOptions& options, const Stage& stage) {
    constexpr double kPart = 1 / 1.06;  // of the picture, for what is to be seen; the rest is margin
    const double aspect = aspect_of(options.picture);
    const Viewport viewport{-0.5 * kPart * aspect, -0.5 * kPart, kPart * aspect, kPart};
    return make_camera(options.scene, stage, options.picture.view, viewport);
}

std::string pov_head(const WriterOptions& options, const Stage& stage, const Camera& camera, const ColorScale& colors) {
    const double size = length(stage.bounds.max - stage.bounds.min);
    const Vec3 middle = 0.5 * (stage.bounds.min + stage.bounds.max);
    std::string text =
        "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level 24 }\nbackground { rgb 1 }\n";
    text += camera_text(camera, aspect_of(options.picture), middle, size) + lights_text(camera, middle, size);
    text += pov_object_looks();
    // Staubach 2010, Eq. 3.5: cbrt(3 m / (4 pi rho0)); in 2D the disc of the particle's area.
    text += "#declare R = " + pov_number(particle_radius(options.scene)) + ";\n#declare T = array[" +
            std::to_string(kPovShades + 1) + "];\n";
    for (int k = 0; k <= kPovShades; ++k) {
        const Rgb c =
            k == kPovShades ? kNotANumber : palette_color(static_cast<double>(k) / (kPovShades - 1), colors.palette);
        text += "#declare T[" + std::to_string(k) + "] = texture { pigment { srgb " +
                pov_vector({c.r / 255.0, c.g / 255.0, c.b / 255.0}) + " } " + kParticleFinish + " }\n";
    }
    return text;
}

void append_pov_particle(std::string& text, const Vec3& center, int shade) {
    text += "sphere{<";
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis > 0) text += ',';
        append_pov_number(text, center[axis]);
    }
    text += ">,R texture{T[" + std::to_string(shade) + "]}}\n";
}

}  // namespace headrace::client
