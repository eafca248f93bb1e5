#include "client/writers/frame_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "client/writers/annotations.h"

namespace headrace::client {

namespace {

// Text grows with the picture; 1 at 1280 x 720.
double text_scale(const PictureOptions& picture) {
    return std::min(picture.width / 1280.0, picture.height / 720.0);
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

}  // namespace

FramePicture::FramePicture(const WriterOptions& options)
    : options_(options),
      colors_(make_color_scale(options.scene, options.picture)),
      renderer_(options.scene, colors_, options.picture.width, options.picture.height, scene_viewport(options.picture),
                options.picture.view) {}

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

void FramePicture::annotate(Image& image, const proto::FrameInfo& info) const {
    const double scale = text_scale(options_.picture);
    draw_text(image, 28 * scale, 38 * scale, 22 * scale, title(), Weight::bold);
    // Columns, so that running numbers do not push each other about.
    const double columns[3] = {28, 158 + 9.0 * time_decimals(options_.scene.output.interval), 330};
    draw_text(image, columns[0] * scale, 62 * scale, 16 * scale, time_label(info.time));
    draw_text(image, columns[1] * scale, 62 * scale, 16 * scale, "step " + grouped(info.step));
    draw_text(image, columns[2] * scale, 62 * scale, 16 * scale, grouped(info.particle_count) + " particles");
    const Camera& camera = renderer_.camera();
    if (!camera.is_perspective())
        draw_scale_bar(image, 28 * scale, image.height - 14 * scale, camera.pixels_per_metre(0), scale);
    draw_color_bar(image, bar_box(image.height, image.width - static_cast<int>(12 * scale), scale), colors_, scale);
}

}  // namespace headrace::client
