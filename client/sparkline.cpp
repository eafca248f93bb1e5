#include "client/sparkline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

namespace headrace::client {

namespace {

constexpr std::size_t kLevels = 8;
constexpr std::array<std::string_view, kLevels> kBlocks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::array<std::string_view, kLevels> kMarks{"_", ".", ",", "-", "~", "=", "*", "#"};

}  // namespace

Glyphs locale_glyphs() {
    for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
        const char* value = std::getenv(name);
        if (value == nullptr || *value == '\0') continue;
        const std::string_view locale(value);
        const bool is_utf8 =
            locale.find("UTF-8") != std::string_view::npos || locale.find("utf8") != std::string_view::npos;
        return is_utf8 ? Glyphs::unicode : Glyphs::ascii;
    }
    return Glyphs::ascii;
}

std::string sparkline(const std::deque<double>& values, std::size_t width, Glyphs glyphs) {
    const auto& marks = glyphs == Glyphs::unicode ? kBlocks : kMarks;
    const std::size_t first = values.size() - std::min(width, values.size());
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = first; k < values.size(); ++k) {
        if (!std::isfinite(values[k])) continue;
        low = std::min(low, values[k]);
        high = std::max(high, values[k]);
    }
    std::string line;
    for (std::size_t k = first; k < values.size(); ++k) {
        if (!std::isfinite(values[k])) {
            line += '!';
            continue;
        }
        const double share = high > low ? (values[k] - low) / (high - low) : 0.0;
        line += marks[std::min<std::size_t>(static_cast<std::size_t>(share * double{kLevels}), kLevels - 1)];
    }
    return line;
}

}  // namespace headrace::client
