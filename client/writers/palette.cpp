#include "client/writers/palette.h"

#include <algorithm>
#include <cmath>

namespace headrace::client {

Rgb palette_color(double t) {
    if (std::isnan(t)) return kNotANumber;
    const double place = std::clamp(t, 0.0, 1.0) * (kViridis.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
    const double share = place - static_cast<double>(below);
    const Rgb &a = kViridis[below], &b = kViridis[below + 1];
    const auto mix = [share](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
    };
    return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

}  // namespace headrace::client
