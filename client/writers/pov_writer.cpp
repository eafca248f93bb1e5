// Scenes for POV-Ray 3.7: one <stem>_000123.pov per frame, seen as the pictures are. Render with
// `povray wave_000123.pov +W1280 +H720 +A`.
#include <algorithm>
#include <cmath>

#include "client/writers/file_output.h"
#include "client/writers/formats.h"
#include "client/writers/pov_objects.h"
#include "client/writers/pov_scene.h"
#include "client/writers/pov_text.h"
#include "client/writers/scene_view.h"
#include "client/writers/stage.h"

namespace headrace::client {

namespace {

class PovWriter final : public Writer {
  public:
    explicit PovWriter(const WriterOptions& options)
        : options_(options),
          colors_(make_color_scale(options.scene, options.picture)),
          stage_(make_stage(options.scene, options.picture.view, options.extents)),
          camera_(make_pov_camera(options, stage_)),
          head_(pov_head(options, stage_, camera_, colors_)) {}

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
            "// t = " + pov_number(frame.info.time) + " s, step " + std::to_string(frame.info.step) + "\n" + head_;
        text.reserve(text.size() + 64 * positions.size());
        for (std::size_t k = 0; k < positions.size(); ++k)
            if (is_shown(positions[k])) append_pov_particle(text, positions[k], shade_of(values[k]));
        text += pov_objects(task.objects, options_.scene, stage_, camera_);
        const std::string name = numbered_name(options_.stem, task.number, frame_extension());
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

    std::string_view frame_extension() const override { return "pov"; }

  private:
    bool is_shown(const Vec3& x) const {
        if (!std::isfinite(x[0] + x[1] + x[2])) return false;
        if (!stage_.hides_rest) return true;
        for (std::size_t axis = 0; axis < (options_.scene.dimensions == 2 ? 2u : 3u); ++axis)
            if (x[axis] < stage_.bounds.min[axis] || x[axis] > stage_.bounds.max[axis]) return false;
        return true;
    }

    int shade_of(float value) const {
        const double t = (value - colors_.min) / (colors_.max - colors_.min);
        return std::isnan(t) ? kPovShades : static_cast<int>(std::round(std::clamp(t, 0.0, 1.0) * (kPovShades - 1)));
    }

    WriterOptions options_;
    ColorScale colors_;
    Stage stage_;
    Camera camera_;
    std::string head_;
    std::size_t frames_{0};
};

}  // namespace

std::unique_ptr<Writer> make_pov_writer(const WriterOptions& options) {
    return std::make_unique<PovWriter>(options);
}

}  // namespace headrace::client
