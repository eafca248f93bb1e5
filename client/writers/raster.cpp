#include "client/writers/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace headrace::client {

namespace {

// Light from the upper left behind the viewer, in camera axes (right, up, backward); chosen by looking.
const Vec3 kLight = normalized({-0.35, 0.6, 0.72});
// The brightest shade is 1, so that the lit side shows the palette's colour as the bar does.
constexpr float kAmbient = 0.46f, kDiffuse = 0.54f;
// A soft highlight towards white: it gives the palette's dark end a shape.
const Vec3 kHighlight = normalized(kLight + Vec3{0, 0, 1});
constexpr float kGloss = 0.30f;

constexpr float kInfinitelyFar = -std::numeric_limits<float>::infinity();

struct Light {
    float x, y, z;
    explicit Light(const Vec3& d)
        : x(static_cast<float>(d[0])), y(static_cast<float>(d[1])), z(static_cast<float>(d[2])) {}
    float facing(float u, float v, float w) const { return std::max(0.0f, x * u + y * v + z * w); }
};

std::uint32_t shaded(Rgb color, float u, float v, float w) {
    static const Light light(kLight), highlight(kHighlight);
    const float lit = kAmbient + kDiffuse * light.facing(u, v, w);
    float gloss = highlight.facing(u, v, w);
    gloss *= gloss, gloss *= gloss, gloss *= gloss;  // 8th power
    const auto shade = static_cast<std::uint32_t>(256 * lit), white = static_cast<std::uint32_t>(256 * kGloss * gloss);
    const auto channel = [&](std::uint32_t c) {
        c = c * shade >> 8;
        return c + ((255 - c) * white >> 8);
    };
    return 0xFF000000u | channel(color.r) << 16 | channel(color.g) << 8 | channel(color.b);
}

}  // namespace

Raster::Raster(int width, int height, const Camera& camera, const std::optional<Viewport>& clip)
    : width_(width * kOversampling),
      height_(height * kOversampling),
      window_{0, width_, 0, height_},
      camera_(camera),
      fine_(camera.magnified(kOversampling)),
      nearness_(static_cast<std::size_t>(width_) * height_, kInfinitelyFar),
      color_(nearness_.size()) {
    if (!clip) return;
    const auto fine = [](double pixels) { return kOversampling * std::round(pixels); };
    window_ =
        clipped(fine(clip->left), fine(clip->left + clip->width), fine(clip->top), fine(clip->top + clip->height));
}

void Raster::clear(Rgb color) {
    std::fill(nearness_.begin(), nearness_.end(), kInfinitelyFar);
    std::fill(color_.begin(), color_.end(), Image::packed(color));
}

void Raster::particle(const Vec3& center, double radius, Rgb color) {
    const Projected p = fine_.project(center);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || fine_.pixels_per_metre(p.nearness) <= 0) return;
    // At least one pixel of the picture wide, so that far spray does not twinkle.
    const double r = std::max(radius * fine_.pixels_per_metre(p.nearness), 0.5 * kOversampling);
    const Range range = clipped(p.x - r, p.x + r, p.y - r, p.y + r);

    const float per_radius = static_cast<float>(1 / r), middle = static_cast<float>(p.nearness);
    const float bulge = static_cast<float>(radius * fine_.nearness_per_metre(p.nearness));
    const float nearest = middle + bulge;
    const float u0 = static_cast<float>((range.x0 + 0.5 - p.x) / r);
    for (int y = range.y0; y < range.y1; ++y) {
        const float v = static_cast<float>((p.y - y - 0.5) / r);
        float* nearness = nearness_.data() + static_cast<std::size_t>(y) * width_ + range.x0;
        std::uint32_t* pixel = color_.data() + static_cast<std::size_t>(y) * width_ + range.x0;
        for (int k = 0; k < range.x1 - range.x0; ++k) {
            if (nearest <= nearness[k]) continue;
            const float u = u0 + static_cast<float>(k) * per_radius;
            const float inside = 1 - u * u - v * v;
            if (inside <= 0) continue;
            const float w = std::sqrt(inside);  // (u, v, w) is the normal
            if (middle + bulge * w <= nearness[k]) continue;
            nearness[k] = middle + bulge * w;
            pixel[k] = shaded(color, u, v, w);
        }
    }
}

void Raster::polygon(std::span<const Vec3> corners, Rgb color, double alpha) {
    std::vector<Projected> p;
    for (const Vec3& corner : corners) p.push_back(fine_.project(corner));
    double top = height_, bottom = 0;
    for (const Projected& corner : p) top = std::min(top, corner.y), bottom = std::max(bottom, corner.y);

    // Nearness over the picture from the triangle of the first corner with the largest area.
    double area = 0, along_x = 0, along_y = 0;
    for (std::size_t k = 1; k + 1 < p.size(); ++k) {
        const double x1 = p[k].x - p[0].x, y1 = p[k].y - p[0].y, n1 = p[k].nearness - p[0].nearness;
        const double x2 = p[k + 1].x - p[0].x, y2 = p[k + 1].y - p[0].y, n2 = p[k + 1].nearness - p[0].nearness;
        const double determinant = x1 * y2 - x2 * y1;
        if (std::abs(determinant) <= std::abs(area)) continue;
        area = determinant;
        along_x = (n1 * y2 - n2 * y1) / determinant;
        along_y = (x1 * n2 - x2 * n1) / determinant;
    }
    if (area == 0) return;  // seen edge-on

    const std::uint32_t part = parts(alpha);
    const Range rows = clipped(0, width_, top, bottom);
    for (int y = rows.y0; y < rows.y1; ++y) {
        double left = width_, right = 0;
        for (std::size_t k = 0; k < p.size(); ++k) {
            const Projected &a = p[k], &b = p[(k + 1) % p.size()];
            if ((a.y <= y + 0.5) == (b.y <= y + 0.5)) continue;
            const double x = a.x + (b.x - a.x) * (y + 0.5 - a.y) / (b.y - a.y);
            left = std::min(left, x), right = std::max(right, x);
        }
        // Pixels whose centre is inside, so that polygons side by side never blend twice.
        const int x0 = std::max(window_.x0, static_cast<int>(std::ceil(left - 0.5)));
        const int x1 = std::min(window_.x1, static_cast<int>(std::ceil(right - 0.5)));
        for (int x = x0; x < x1; ++x) {
            const double nearness = p[0].nearness + along_x * (x + 0.5 - p[0].x) + along_y * (y + 0.5 - p[0].y);
            const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
            if (nearness >= nearness_[pixel]) blend(pixel, color, part);
        }
    }
}

void Raster::line(const Vec3& from, const Vec3& to, double width_px, Rgb color, double alpha) {
    const Projected a = fine_.project(from), b = fine_.project(to);
    const double span = std::hypot(b.x - a.x, b.y - a.y);
    if (span == 0) return;
    const double ex = (b.x - a.x) / span, ey = (b.y - a.y) / span;  // along the line; (-ey, ex) across it
    const double half = 0.5 * width_px * kOversampling, reach = half + 0.5;

    const Range range = clipped(std::min(a.x, b.x) - reach, std::max(a.x, b.x) + reach, std::min(a.y, b.y) - reach,
                                std::max(a.y, b.y) + reach);
    for (int y = range.y0; y < range.y1; ++y) {
        // Only the part of the row within reach of the line.
        const double dy = y + 0.5 - a.y;
        int x0 = range.x0, x1 = range.x1;
        if (std::abs(ey) > 1e-9) {
            const double middle = a.x + dy * ex / ey, spread = reach / std::abs(ey);
            x0 = std::max(x0, static_cast<int>(std::floor(std::max(middle - spread, -1.0))));
            x1 = std::min(x1, static_cast<int>(std::ceil(std::min(middle + spread, width_ + 1.0))));
        }
        for (int x = x0; x < x1; ++x) {
            const double dx = x + 0.5 - a.x;
            const double along = dx * ex + dy * ey, across = std::abs(dy * ex - dx * ey);
            // Half open, so that the pieces of a polyline do not blend twice where they meet.
            if (along < 0 || along >= span) continue;
            const double coverage = std::clamp(half + 0.5 - across, 0.0, 1.0);
            const double nearness = a.nearness + (b.nearness - a.nearness) * along / span;
            const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
            if (coverage > 0 && nearness >= nearness_[pixel]) blend(pixel, color, parts(alpha * coverage));
        }
    }
}

void Raster::resolve(Image& image) const {
    static_assert(kOversampling == 2);
    for (int y = 0; y < image.height; ++y) {
        const std::uint32_t* upper = color_.data() + static_cast<std::size_t>(2 * y) * width_;
        const std::uint32_t* lower = upper + width_;
        std::uint32_t* out = image.row(y);
        for (int x = 0; x < image.width; ++x) {
            // Two channels at once: 8 bits with 8 bits of room above each.
            const std::uint32_t four[4] = {upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]};
            std::uint32_t red_blue = 0x00020002u, green = 0x00000200u;
            for (const std::uint32_t pixel : four) red_blue += pixel & 0x00FF00FFu, green += pixel & 0x0000FF00u;
            out[x] = 0xFF000000u | ((red_blue >> 2) & 0x00FF00FFu) | ((green >> 2) & 0x0000FF00u);
        }
    }
}

Raster::Range Raster::clipped(double left, double right, double top, double bottom) const {
    const auto cut = [](double value, int from, int to) {
        return static_cast<int>(std::clamp(value, static_cast<double>(from), static_cast<double>(to)));
    };
    return {cut(std::floor(left), window_.x0, window_.x1), cut(std::ceil(right), window_.x0, window_.x1),
            cut(std::floor(top), window_.y0, window_.y1), cut(std::ceil(bottom), window_.y0, window_.y1)};
}

void Raster::blend(std::size_t pixel, Rgb color, std::uint32_t part) {
    const std::uint32_t below = color_[pixel], rest = 256 - part;
    const auto mix = [&](unsigned shift, std::uint32_t over) {
        return (((below >> shift & 0xFF) * rest + over * part + 128) >> 8) << shift;
    };
    color_[pixel] = 0xFF000000u | mix(16, color.r) | mix(8, color.g) | mix(0, color.b);
}

}  // namespace headrace::client
