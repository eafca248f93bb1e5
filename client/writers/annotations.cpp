#include "client/writers/annotations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "client/writers/cairo_canvas.h"
#include "client/writers/palette.h"

namespace headrace::client {

namespace {

constexpr Rgb kInk{0x22, 0x2B, 0x35};

void select_font(const Canvas& canvas, double size, Weight weight) {
    cairo_select_font_face(canvas(), "sans", CAIRO_FONT_SLANT_NORMAL,
                           weight == Weight::bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(canvas(), size);
}

void show_text(const Canvas& canvas, double x, double y, const std::string& text) {
    canvas.set_color(kInk);
    cairo_move_to(canvas(), x, y);
    cairo_show_text(canvas(), text.c_str());
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

// The largest of 1, 2, 5 times a power of ten that is not larger.
double rounded_down(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    double rounded = power;
    for (const double nice : {2.0, 5.0})
        if (nice * power <= value) rounded = nice * power;
    return rounded;
}

// "m/s^2" -> "m/s²"
std::string typeset_unit(std::string_view unit) {
    std::string text;
    bool is_raised = false;
    for (const char letter : unit) {
        if (is_raised && letter == '2')
            text += "²";
        else if (is_raised && letter == '3')
            text += "³";
        else if (letter != '^')
            text += letter;
        is_raised = letter == '^';
    }
    return text;
}

}  // namespace

BarBox bar_box(int picture_height, int right_edge, double scale) {
    const int width = static_cast<int>(std::lround(18 * scale));
    const int labels = static_cast<int>(std::lround(92 * scale));
    // In small pictures below the lines of text.
    const int top = std::max(static_cast<int>(0.24 * picture_height), static_cast<int>(128 * scale));
    const int height = std::min(static_cast<int>(0.58 * picture_height), picture_height - top - 4);
    return {right_edge - width - labels, top, width, std::max(height, 2)};
}

void draw_color_bar(Image& image, const BarBox& box, const ColorScale& colors, double scale) {
    for (int y = 0; y < box.height; ++y) {
        const double t = box.height > 1 ? 1 - static_cast<double>(y) / (box.height - 1) : 0;
        std::uint32_t* row = image.row(box.top + y) + box.left;
        std::fill_n(row, box.width, Image::packed(palette_color(t, colors.palette)));
    }

    const Canvas canvas(image);
    const double right = box.left + box.width;
    canvas.set_color(kInk);
    cairo_set_line_width(canvas(), 1);
    // The frame runs outside the colours.
    cairo_rectangle(canvas(), box.left - 0.5, box.top - 0.5, box.width + 1, box.height + 1);
    cairo_stroke(canvas());

    select_font(canvas, 14 * scale, Weight::normal);
    for (const double value : tick_values(colors.min, colors.max, 6)) {
        const double t = (value - colors.min) / (colors.max - colors.min);
        const double y = box.top + box.height - 0.5 - t * (box.height - 1);
        canvas.set_color(kInk);
        cairo_move_to(canvas(), right + 1, y);
        cairo_line_to(canvas(), right + 1 + 5 * scale, y);
        cairo_stroke(canvas());
        show_text(canvas, right + 10 * scale, y + 5 * scale, short_number(value));
    }

    const proto::FieldInfo& info = proto::field_info(colors.field);
    select_font(canvas, 15 * scale, Weight::bold);
    show_text(canvas, box.left, box.top - 32 * scale, std::string(info.name));
    select_font(canvas, 14 * scale, Weight::normal);
    std::string legend(info.symbol);
    if (info.is_vector) legend = "|" + legend + "|";  // colours stand for the magnitude
    if (info.unit != "1") legend.append("  [").append(typeset_unit(info.unit)).append("]");
    show_text(canvas, box.left, box.top - 13 * scale, legend);
}

bool draw_ruler(Image& image, const Camera& camera, const Vec3& from, const Vec3& to, double room, double scale) {
    const double whole = length(to - from), round = rounded_down(whole / 3);
    const Vec3 end = from + (round / whole) * (to - from);
    const Projected a = camera.project(from), b = camera.project(end);
    const double span = std::hypot(b.x - a.x, b.y - a.y);
    if (!(span > 20 * scale)) return false;
    // Across the line, downwards.
    double across_x = -(b.y - a.y) / span, across_y = (b.x - a.x) / span;
    if (across_y < 0) across_x = -across_x, across_y = -across_y;
    const double gap = 11 * scale + room * camera.pixels_per_metre(a.nearness), tick = 4 * scale;
    const auto at = [&](const Projected& p, double offset) {
        return std::pair{p.x + offset * across_x, p.y + offset * across_y};
    };
    const Canvas canvas(image);
    select_font(canvas, 14 * scale, Weight::normal);
    const std::string label = short_number(round) + " m";
    cairo_text_extents_t text;
    cairo_text_extents(canvas(), label.c_str(), &text);
    const double x = 0.5 * (a.x + b.x) + (gap + 6 * scale) * across_x - 0.5 * text.width;
    const double y = 0.5 * (a.y + b.y) + (gap + 6 * scale) * across_y + text.height + 4 * scale;
    for (const auto& [px, py] : {at(a, gap + tick), at(b, gap + tick), std::pair{x, y}, std::pair{x + text.width, y}})
        if (px < 4 * scale || py < 0 || px > image.width - 4 * scale || py > image.height - 4 * scale) return false;
    canvas.set_color(kInk);
    cairo_set_line_width(canvas(), 1.5 * scale);
    const auto line = [&](const std::pair<double, double>& p, const std::pair<double, double>& q) {
        cairo_move_to(canvas(), p.first, p.second);
        cairo_line_to(canvas(), q.first, q.second);
    };
    line(at(a, gap), at(b, gap));
    for (const Projected& p : {a, b}) line(at(p, gap - tick), at(p, gap + tick));
    cairo_stroke(canvas());
    show_text(canvas, x, y, label);
    return true;
}

void draw_axes(Image& image, const Camera& camera, double x, double y, double scale) {
    const Canvas canvas(image);
    select_font(canvas, 12 * scale, Weight::normal);
    cairo_set_line_width(canvas(), 1.5 * scale);
    for (std::size_t k = 0; k < 3; ++k) {
        Vec3 axis{};
        axis[k] = 1;
        const double dx = dot(axis, camera.right()), dy = -dot(axis, camera.up()), seen = std::hypot(dx, dy);
        if (seen < 0.05) continue;  // towards the viewer
        const double arrow = 22 * scale, ux = dx / seen, uy = dy / seen, head = 6 * scale;
        const double tip_x = x + arrow * dx, tip_y = y + arrow * dy;
        canvas.set_color(kInk);
        cairo_move_to(canvas(), x, y);
        cairo_line_to(canvas(), tip_x, tip_y);
        cairo_stroke(canvas());
        cairo_move_to(canvas(), tip_x + 0.5 * head * ux, tip_y + 0.5 * head * uy);
        cairo_line_to(canvas(), tip_x - 0.5 * head * (ux - 0.7 * uy), tip_y - 0.5 * head * (uy + 0.7 * ux));
        cairo_line_to(canvas(), tip_x - 0.5 * head * (ux + 0.7 * uy), tip_y - 0.5 * head * (uy - 0.7 * ux));
        cairo_fill(canvas());
        show_text(canvas, tip_x + 10 * scale * ux - 4 * scale, tip_y + 10 * scale * uy + 4 * scale,
                  std::string(1, "xyz"[k]));
    }
}

void draw_scale_bar(Image& image, double x, double y, double pixels_per_metre, double scale) {
    const double metres = rounded_down(160 * scale / pixels_per_metre);  // takes at most 160 px
    const double right = x + metres * pixels_per_metre, tick = 4 * scale;
    const Canvas canvas(image);
    canvas.set_color(kInk);
    cairo_set_line_width(canvas(), 1.5 * scale);
    cairo_move_to(canvas(), x, y - tick);
    cairo_line_to(canvas(), x, y + tick);
    cairo_move_to(canvas(), x, y);
    cairo_line_to(canvas(), right, y);
    cairo_move_to(canvas(), right, y - tick);
    cairo_line_to(canvas(), right, y + tick);
    cairo_stroke(canvas());
    select_font(canvas, 14 * scale, Weight::normal);
    show_text(canvas, right + 8 * scale, y + 5 * scale, short_number(metres) + " m");
}

void draw_text(Image& image, double x, double y, double size, const std::string& text, Weight weight) {
    const Canvas canvas(image);
    select_font(canvas, size, weight);
    show_text(canvas, x, y, text);
}

std::vector<double> tick_values(double min, double max, int wanted) {
    const double raw = (max - min) / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    double step = 10 * power;
    for (const double nice : {5.0, 2.0, 1.0})
        if (nice * power >= raw * (1 - 1e-9)) step = nice * power;
    std::vector<double> ticks;
    const double slack = 1e-9 * (max - min);
    for (double k = std::ceil((min - slack) / step); k * step <= max + slack; ++k)
        ticks.push_back(k * step + 0.0);  // + 0.0: never "-0"
    return ticks;
}

std::string grouped(std::uint64_t count) {
    const std::string digits = std::to_string(count);
    std::string text;
    for (std::size_t k = 0; k < digits.size(); ++k) {
        if (k > 0 && (digits.size() - k) % 3 == 0) text += ',';
        text += digits[k];
    }
    return text;
}

}  // namespace headrace::client
