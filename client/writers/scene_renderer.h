// A frame's particles and objects as an image, without text.
#pragma once

#include <span>
#include <vector>

#include "client/writers/image.h"
#include "client/writers/raster.h"
#include "client/writers/scene_view.h"

namespace headrace::client {

inline constexpr Rgb kPaper{0xFF, 0xFF, 0xFF};  // background of all pictures

// Owner: one thread. Its buffers are kept from frame to frame.
class SceneRenderer {
  public:
    SceneRenderer(const proto::SceneDesc& scene, const ColorScale& colors, int width, int height,
                  const Viewport& viewport);

    // One value per position: its colour on the scale.
    Image draw(std::span<const Vec3> positions, std::span<const float> values,
               const std::vector<proto::ObjectDesc>& objects);

    const Camera& camera() const { return raster_.camera(); }

  private:
    std::vector<std::size_t> front_to_back(std::span<const Vec3> positions) const;

    int dimensions_;
    double radius_;  // [m] of a particle
    ColorScale colors_;
    std::vector<Rgb> palette_;
    int width_, height_;  // [px]
    Raster raster_;
};

}  // namespace headrace::client
