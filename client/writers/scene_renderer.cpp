#include "client/writers/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/writers/object_drawing.h"
#include "client/writers/palette.h"

namespace headrace::client {

namespace {

constexpr Rgb kFrame{0xB4, 0xBC, 0xC4};
constexpr std::size_t kShades = 1024;  // finer than 8 bits a channel can show

}  // namespace

SceneRenderer::SceneRenderer(const proto::SceneDesc& scene, const Stage& stage, const ColorScale& colors, int width,
                             int height, const Viewport& viewport, const ViewOptions& view)
    : dimensions_(scene.dimensions),
      radius_(particle_radius(scene)),
      stage_(stage),
      colors_(colors),
      width_(width),
      height_(height),
      camera_(make_camera(scene, stage, view, viewport)),
      is_framed_(stage.is_part && (stage.hides_rest || view.zoom != 1)),
      clip_(clip_of(stage, view, camera_, viewport)) {
    for (std::size_t k = 0; k < kShades; ++k)
        palette_.push_back(palette_color(static_cast<double>(k) / (kShades - 1), colors.palette));
}

Raster SceneRenderer::borrow_raster() const {
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            Raster raster = std::move(idle_.back());
            idle_.pop_back();
            return raster;
        }
    }
    return {width_, height_, camera_, clip_};
}

void SceneRenderer::give_back(Raster raster) const {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(raster));
}

// Near particles first: hidden ones then end at the depth test. With 98,304 particles this takes 51 ms instead of 127.
std::vector<std::size_t> SceneRenderer::front_to_back(std::span<const Vec3> positions) const {
    std::vector<std::pair<float, std::size_t>> by_depth(positions.size());
    for (std::size_t k = 0; k < positions.size(); ++k) {
        const auto depth = static_cast<float>(-dot(positions[k], camera().backward()));
        // Not a number has no place in an order; such a particle is not drawn anyway.
        by_depth[k] = {std::isnan(depth) ? 0.0f : depth, k};
    }
    std::sort(by_depth.begin(), by_depth.end());
    std::vector<std::size_t> order(positions.size());
    std::transform(by_depth.begin(), by_depth.end(), order.begin(), [](const auto& entry) { return entry.second; });
    return order;
}

void SceneRenderer::draw_frame(Image& image) const {
    const auto edge = [](double place, int size) { return std::clamp(static_cast<int>(std::lround(place)), 0, size); };
    const int left = edge(clip_->left, width_), right = edge(clip_->left + clip_->width, width_);
    const int top = edge(clip_->top, height_), bottom = edge(clip_->top + clip_->height, height_);
    if (right - left < 2 || bottom - top < 2) return;
    const std::uint32_t color = Image::packed(kFrame);
    for (const int y : {top, bottom - 1}) std::fill(image.row(y) + left, image.row(y) + right, color);
    for (int y = top; y < bottom; ++y)
        for (const int x : {left, right - 1}) image.row(y)[x] = color;
}

Image SceneRenderer::draw(std::span<const Vec3> positions, std::span<const float> values,
                          const std::vector<PlacedObject>& objects) const {
    Raster raster = borrow_raster();
    raster.clear(kPaper);
    const double per_value = (kShades - 1) / (colors_.max - colors_.min);
    for (const std::size_t k : front_to_back(positions)) {
        const double shade = std::clamp((values[k] - colors_.min) * per_value, 0.0, kShades - 1.0);
        raster.particle(positions[k], radius_,
                        std::isnan(values[k]) ? kNotANumber : palette_[static_cast<std::size_t>(shade + 0.5)]);
    }
    if (dimensions_ == 2)
        draw_flat_objects(raster, objects, stage_, 2 * radius_);
    else
        draw_objects(raster, objects, stage_);

    Image image(width_, height_, kPaper);
    raster.resolve(image);
    give_back(std::move(raster));
    if (is_framed_) draw_frame(image);
    return image;
}

}  // namespace headrace::client
