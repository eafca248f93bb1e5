// What is written on a picture: the colour bar and lines of text.
#pragma once

#include <string>
#include <vector>

#include "client/writers/camera.h"
#include "client/writers/image.h"
#include "client/writers/scene_view.h"

namespace headrace::client {

// The coloured area of a bar: ascends from its bottom row to its top row [px].
struct BarBox {
    int left{}, top{}, width{}, height{};
};

// Where the bar goes in a picture that keeps `margin` [px] free on its right; room for the labels included.
BarBox bar_box(int picture_height, int right_edge, double scale);

// The bar with its frame, ticks, the field's name and its unit. `scale`: size of text, 1 for a picture 720 px high.
void draw_color_bar(Image& image, const BarBox& box, const ColorScale& colors, double scale);

// A bar of a round length with that length beside it; x, y: its left end [px]. For views without perspective.
void draw_scale_bar(Image& image, double x, double y, double pixels_per_metre, double scale);

// The same along a straight line of the scene, seen at any angle: from `from` towards `to` [m], by at most a third of
// the way, `room` [m] and a little below the line. False, and nothing drawn, where that is not all within the picture.
bool draw_ruler(Image& image, const Camera& camera, const Vec3& from, const Vec3& to, double room, double scale);

// Three arrows from x, y [px] that tell how the axes are seen.
void draw_axes(Image& image, const Camera& camera, double x, double y, double scale);

enum class Weight { normal, bold };
// x, y: left end of the base line [px]; size: of the font [px].
void draw_text(Image& image, double x, double y, double size, const std::string& text, Weight weight = Weight::normal);

// Round numbers within [min, max], about `wanted` of them.
std::vector<double> tick_values(double min, double max, int wanted);

// 98304 -> "98,304"
std::string grouped(std::uint64_t count);

}  // namespace headrace::client
