#include "client/writers/palette.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace headrace::client {

namespace {

std::span<const Rgb> table_of(Palette palette) {
    switch (palette) {
        case Palette::cividis:
            return kCividis;
        case Palette::magma:
            return kMagma;
        case Palette::coolwarm:
            return kCoolwarm;
        case Palette::viridis:
            break;
    }
    return kViridis;
}

}  // namespace

Rgb palette_color(double t, Palette palette) {
    if (std::isnan(t)) return kNotANumber;
    const std::span<const Rgb> table = table_of(palette);
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(table.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), table.size() - 2);
    const double share = place - static_cast<double>(below);
    const Rgb &a = table[below], &b = table[below + 1];
    const auto mix = [share](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
    };
    return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

}  // namespace headrace::client
