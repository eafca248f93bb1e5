// Pictures: <stem>_000123.png per frame and <stem>_sheet.png with a selection of frames.
#include <algorithm>
#include <cmath>
#include <optional>

#include "client/writers/contact_sheet.h"
#include "client/writers/file_output.h"
#include "client/writers/formats.h"
#include "client/writers/frame_picture.h"

namespace headrace::client {

namespace {

constexpr int kCellArea = 380 * 240;  // [px^2] of a picture on the contact sheet

class PictureWriter final : public Writer {
  public:
    explicit PictureWriter(const WriterOptions& options)
        : options_(options),
          picture_(options),
          sheet_(static_cast<std::size_t>(options.picture.sheet_frames), options.expected_frames) {
        if (options.picture.sheet_frames > 0) make_small_renderer();
    }

    proto::Result<InOrder> prepare(const FrameTask& task) override {
        const proto::FrameView& frame = task.frame;
        if (auto checked = picture_.check_frame(frame); !checked) return checked.error();
        std::optional<Image> cell;
        if (small_ && sheet_.wants(task.number))
            cell = small_->draw(particle_positions(frame), color_values(frame, options_.picture.color_field),
                                task.objects);
        if (options_.picture.every_frame) {
            const std::string name = numbered_name(options_.stem, task.number, frame_extension());
            if (auto done = write_png(options_.folder / name, picture_.draw(task)); !done) return done.error();
        }
        return InOrder(
            [this, number = task.number, cell = std::move(cell), label = picture_.time_label(frame.info.time)] {
                if (cell) sheet_.add(number, *cell, label);
                ++frames_;
                return proto::Status(proto::Done{});
            });
    }

    proto::Status finish() override {
        if (!small_ || frames_ == 0) return proto::Done{};
        return write_png(sheet_path(), sheet_.compose(picture_.title(), picture_.colors()));
    }

    std::string summary() const override {
        std::string text;
        if (options_.picture.every_frame)
            text = std::to_string(frames_) + " pictures " + (options_.folder / (options_.stem + "_*.png")).string();
        if (small_ && frames_ > 0) text += (text.empty() ? "" : "; ") + ("at a glance: " + sheet_path().string());
        return text;
    }

    std::string_view frame_extension() const override { return options_.picture.every_frame ? "png" : ""; }

  private:
    // Cells have the shape of what they show, so that the sheet wastes no room.
    void make_small_renderer() {
        const Stage& stage = picture_.stage();
        const Viewport seen =
            make_camera(options_.scene, stage, options_.picture.view, {0, 0, 16, 16}).covered(stage.outline);
        const double aspect = std::clamp(seen.width / seen.height, 0.4, 4.0);
        const int width = static_cast<int>(std::sqrt(kCellArea * aspect));
        const int height = static_cast<int>(std::sqrt(kCellArea / aspect));
        small_.emplace(options_.scene, stage, picture_.colors(), width, height,
                       Viewport{10, 10, width - 20.0, height - 20.0}, options_.picture.view);
    }

    std::filesystem::path sheet_path() const { return options_.folder / (options_.stem + "_sheet.png"); }

    WriterOptions options_;
    FramePicture picture_;
    std::optional<SceneRenderer> small_;  // absent: no sheet
    ContactSheet sheet_;
    std::size_t frames_{0};
};

}  // namespace

std::unique_ptr<Writer> make_picture_writer(const WriterOptions& options) {
    return std::make_unique<PictureWriter>(options);
}

}  // namespace headrace::client
