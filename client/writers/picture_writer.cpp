// Pictures: <stem>_000123.png per frame and <stem>_sheet.png with a selection of frames.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "client/writers/annotations.h"
#include "client/writers/contact_sheet.h"
#include "client/writers/file_output.h"
#include "client/writers/formats.h"
#include "client/writers/scene_renderer.h"

namespace headrace::client {

namespace {

constexpr int kCellArea = 380 * 240;  // [px^2] of a picture on the contact sheet

// Text grows with the picture; 1 at 1280 x 720.
double text_scale(const PictureOptions& picture) {
    return std::min(picture.width / 1280.0, picture.height / 720.0);
}

Viewport scene_viewport(const PictureOptions& picture) {
    const double scale = text_scale(picture);
    const double left = 28 * scale, top = 78 * scale, right = 150 * scale, bottom = 30 * scale;
    return {left, top, picture.width - left - right, picture.height - top - bottom};
}

// Enough digits that frames one output interval apart differ.
int time_decimals(double interval) {
    if (!(interval > 0)) return 3;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(interval) - 1e-9)), 2, 9);
}

class PictureWriter final : public Writer {
  public:
    explicit PictureWriter(const WriterOptions& options)
        : options_(options),
          colors_(make_color_scale(options.scene, options.picture)),
          sheet_(static_cast<std::size_t>(options.picture.sheet_frames), options.expected_frames) {
        const PictureOptions& picture = options.picture;
        if (picture.every_frame)
            large_.emplace(options.scene, colors_, picture.width, picture.height, scene_viewport(picture));
        if (picture.sheet_frames > 0) make_small_renderer();
    }

    proto::Result<InOrder> prepare(const FrameTask& task) override {
        const proto::FrameView& frame = task.frame;
        for (const proto::Field field : {proto::Field::position, options_.picture.color_field})
            if (frame.find(field) == nullptr) return missing(field);
        const bool is_for_sheet = small_ && sheet_.wants(task.number);
        std::optional<Image> cell;
        if (large_ || is_for_sheet) {
            const std::vector<Vec3> positions = particle_positions(frame);
            const std::vector<float> values = color_values(frame, options_.picture.color_field);
            if (is_for_sheet) cell = small_->draw(positions, values, task.objects);
            if (large_) {
                Image image = large_->draw(positions, values, task.objects);
                annotate(image, frame.info);
                const std::string name = numbered_name(options_.stem, task.number, "png");
                if (auto done = write_png(options_.folder / name, image); !done) return done.error();
            }
        }
        return InOrder([this, number = task.number, cell = std::move(cell), label = time_label(frame.info.time)] {
            if (cell) sheet_.add(number, *cell, label);
            ++frames_;
            return proto::Status(proto::Done{});
        });
    }

    proto::Status finish() override {
        if (!small_ || frames_ == 0) return proto::Done{};
        return write_png(sheet_path(), sheet_.compose(title(), colors_));
    }

    std::string summary() const override {
        std::string text;
        if (large_)
            text = std::to_string(frames_) + " pictures " + (options_.folder / (options_.stem + "_*.png")).string();
        if (small_ && frames_ > 0) text += (text.empty() ? "" : "; ") + ("at a glance: " + sheet_path().string());
        return text;
    }

  private:
    // Cells have the shape of what they show, so that the sheet wastes no room.
    void make_small_renderer() {
        const SceneRenderer probe(options_.scene, colors_, 16, 16, {0, 0, 16, 16});
        const Viewport seen = probe.camera().covered(visible_outline(options_.scene));
        const double aspect = std::clamp(seen.width / seen.height, 0.4, 4.0);
        const int width = static_cast<int>(std::sqrt(kCellArea * aspect));
        const int height = static_cast<int>(std::sqrt(kCellArea / aspect));
        small_.emplace(options_.scene, colors_, width, height, Viewport{10, 10, width - 20.0, height - 20.0});
    }

    proto::Error missing(proto::Field field) const {
        const std::string name(proto::field_info(field).name);
        return {proto::ErrorCode::invalid_params, "the frames hold no field `" + name + "`", "fields",
                "record with it, or choose another colour"};
    }

    std::string title() const { return options_.scene.name.empty() ? options_.stem : options_.scene.name; }

    std::string time_label(double time) const {
        char text[48];
        std::snprintf(text, sizeof text, "t = %.*f s", time_decimals(options_.scene.output.interval), time);
        return text;
    }

    void annotate(Image& image, const proto::FrameInfo& info) const {
        const double scale = text_scale(options_.picture);
        draw_text(image, 28 * scale, 38 * scale, 22 * scale, title(), Weight::bold);
        // Columns, so that running numbers do not push each other about.
        const double columns[3] = {28, 158 + 9.0 * time_decimals(options_.scene.output.interval), 330};
        draw_text(image, columns[0] * scale, 62 * scale, 16 * scale, time_label(info.time));
        draw_text(image, columns[1] * scale, 62 * scale, 16 * scale, "step " + grouped(info.step));
        draw_text(image, columns[2] * scale, 62 * scale, 16 * scale, grouped(info.particle_count) + " particles");
        draw_color_bar(image, bar_box(image.height, image.width - static_cast<int>(12 * scale), scale), colors_, scale);
    }

    std::filesystem::path sheet_path() const { return options_.folder / (options_.stem + "_sheet.png"); }

    WriterOptions options_;
    ColorScale colors_;
    std::optional<SceneRenderer> large_;  // absent: no picture of every frame
    std::optional<SceneRenderer> small_;  // absent: no sheet
    ContactSheet sheet_;
    std::size_t frames_{0};
};

}  // namespace

std::unique_ptr<Writer> make_picture_writer(const WriterOptions& options) {
    return std::make_unique<PictureWriter>(options);
}

}  // namespace headrace::client
