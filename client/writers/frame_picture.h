// The picture of one frame with its annotations: title, time, step, colour bar. Shared by pictures and films.
#pragma once

#include <string>
#include <vector>

#include "client/writers/image.h"
#include "client/writers/scene_renderer.h"
#include "client/writers/writer.h"

namespace headrace::client {

class FramePicture {
  public:
    explicit FramePicture(const WriterOptions& options);

    // On any thread, several frames at a time. Precondition: check_frame.
    Image draw(const FrameTask& task) const;

    // Errors: invalid_params for a frame without positions, or without what the colours show.
    proto::Status check_frame(const proto::FrameView& frame) const;

    std::string title() const;
    std::string time_label(double time) const;  // "t = 0.25 s"
    const ColorScale& colors() const { return colors_; }
    const Stage& stage() const { return stage_; }

  private:
    void annotate(Image& image, const proto::FrameInfo& info) const;
    void draw_scale(Image& image, double scale) const;

    WriterOptions options_;
    ColorScale colors_;
    Stage stage_;
    SceneRenderer renderer_;
};

}  // namespace headrace::client
