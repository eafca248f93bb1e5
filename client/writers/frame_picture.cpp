#include "client/writers/frame_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "client/writers/annotations.h"
#include "client/writers/boxes.h"
#include "client/writers/scene_view.h"

namespace headrace::client {

namespace {

// Text grows with the picture, 1 at 1280 x 720, and stays readable in small ones as far as there is room.
double text_scale(const PictureOptions& picture) {
    const double readable = std::min(0.65, picture.width / 490.0);
    return std::max(readable, std::min(picture.width / 1280.0, picture.height / 720.0));
}

Viewport scene_viewport(const PictureOptions& picture) {
    const double scale = text_scale(picture);
    const double left = 28 * scale, top = 78 * scale, right = 150 * scale, bottom = 48 * scale;
    return {left, top, picture.width - left - right, picture.height - top - bottom};
}

// Enough digits that frames one output interval apart differ.
int time_decimals(double interval) {
    if (!(interval > 0)) return 3;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(interval) - 1e-9)), 2, 9);
}

// The nearest of the box's lower edges that run across the picture, from its left end to its right.
std::pair<Vec3, Vec3> front_edge(const proto::BoxDesc& box, const Vec3& up, const Camera& camera) {
    std::pair<Vec3, Vec3> best;
    double best_score = -1;
    for (int k = 0; k < 8; ++k)
        for (const int axis : {1, 2, 4}) {
            const Vec3 a = box_corner(box, k), b = box_corner(box, k ^ axis), along = b - a;
            const double across = dot(along, camera.right());
            const bool is_low = dot(a + b - (box.min + box.max), up) < 0;
            if (!(across > 0) || !is_low || std::abs(dot(along, up)) > 0) continue;
            const bool is_near = dot(a + b - (box.min + box.max), camera.backward()) > 0;
            const double score = across / length(along) + (is_near ? 10 : 0);
            if (score > best_score) best_score = score, best = {a, b};
        }
    return best;
}

}  // namespace

FramePicture::FramePicture(const WriterOptions& options)
    : options_(options),
      colors_(make_color_scale(options.scene, options.picture)),
      stage_(make_stage(options.scene, options.picture.view, options.extents)),
      renderer_(options.scene, stage_, colors_, options.picture.width, options.picture.height,
                scene_viewport(options.picture), options.picture.view) {}

proto::Status FramePicture::check_frame(const proto::FrameView& frame) const {
    for (const proto::Field field : {proto::Field::position, options_.picture.color_field})
        if (frame.find(field) == nullptr)
            return proto::Error{proto::ErrorCode::invalid_params,
                                "the frames hold no field `" + std::string(proto::field_info(field).name) + "`",
                                "fields", "record with it, or choose another colour"};
    return proto::Done{};
}

Image FramePicture::draw(const FrameTask& task) const {
    Image image = renderer_.draw(particle_positions(task.frame), color_values(task.frame, colors_.field), task.objects);
    annotate(image, task.frame.info);
    return image;
}

std::string FramePicture::title() const {
    return options_.scene.name.empty() ? options_.stem : options_.scene.name;
}

std::string FramePicture::time_label(double time) const {
    char text[48];
    std::snprintf(text, sizeof text, "t = %.*f s", time_decimals(options_.scene.output.interval), time);
    return text;
}

// Where the picture's plane is that of two axes, a bar is right anywhere; elsewhere at the lower front edge of what is
// shown, or in the middle, and the axes are told.
void FramePicture::draw_scale(Image& image, double scale) const {
    const Camera& camera = renderer_.camera();
    const Vec3& backward = camera.backward();
    const double left = 28 * scale, low = image.height - 14 * scale;
    const bool is_along_axis =
        std::ranges::any_of(backward, [](double part) { return std::abs(std::abs(part) - 1) < 1e-6; });
    if (!camera.is_perspective() && is_along_axis)
        return draw_scale_bar(image, left, low, camera.pixels_per_metre(0), scale);

    draw_axes(image, camera, left + 10 * scale, low - 2 * scale, scale);
    const auto [from, to] = front_edge(stage_.bounds, up_axis(options_.scene), camera);
    if (draw_ruler(image, camera, from, to, particle_radius(options_.scene), scale)) return;
    const Vec3 middle = 0.5 * (stage_.bounds.min + stage_.bounds.max);
    draw_scale_bar(image, left + 70 * scale, low, camera.pixels_per_metre(camera.project(middle).nearness), scale);
}

void FramePicture::annotate(Image& image, const proto::FrameInfo& info) const {
    const double scale = text_scale(options_.picture);
    draw_text(image, 28 * scale, 38 * scale, 22 * scale, title(), Weight::bold);
    // Columns, so that running numbers do not push each other about.
    const double columns[3] = {28, 158 + 9.0 * time_decimals(options_.scene.output.interval), 330};
    draw_text(image, columns[0] * scale, 62 * scale, 16 * scale, time_label(info.time));
    draw_text(image, columns[1] * scale, 62 * scale, 16 * scale, "step " + grouped(info.step));
    draw_text(image, columns[2] * scale, 62 * scale, 16 * scale, grouped(info.particle_count) + " particles");
    draw_scale(image, scale);
    draw_color_bar(image, bar_box(image.height, image.width - static_cast<int>(12 * scale), scale), colors_, scale);
}

}  // namespace headrace::client
