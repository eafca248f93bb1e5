// A frame's particles and objects as an image, without text.
#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "client/writers/image.h"
#include "client/writers/raster.h"
#include "client/writers/scene_view.h"
#include "client/writers/stage.h"

namespace headrace::client {

inline constexpr Rgb kPaper{0xFF, 0xFF, 0xFF};  // background of all pictures

// Draws on any thread, several frames at a time; its buffers are kept from frame to frame.
class SceneRenderer {
  public:
    SceneRenderer(const proto::SceneDesc& scene, const Stage& stage, const ColorScale& colors, int width, int height,
                  const Viewport& viewport, const ViewOptions& view = {});

    // One value per position: its colour on the scale.
    Image draw(std::span<const Vec3> positions, std::span<const float> values,
               const std::vector<PlacedObject>& objects) const;

    const Camera& camera() const { return camera_; }
    const std::optional<Viewport>& clip() const { return clip_; }

  private:
    Raster borrow_raster() const;
    void give_back(Raster raster) const;
    void draw_frame(Image& image) const;
    std::vector<std::size_t> front_to_back(std::span<const Vec3> positions) const;

    int dimensions_;
    double radius_;  // [m] of a particle
    Stage stage_;
    ColorScale colors_;
    std::vector<Rgb> palette_;
    int width_, height_;  // [px]
    Camera camera_;
    bool is_framed_;  // a part that was asked for: a thin line tells where it ends
    std::optional<Viewport> clip_;
    mutable std::mutex mutex_;          // guards idle_
    mutable std::vector<Raster> idle_;  // at most as many as there were frames in work at a time
};

}  // namespace headrace::client
