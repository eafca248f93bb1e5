// A curve in one line of text.
#pragma once

#include <cstddef>
#include <deque>
#include <string>

namespace headrace::client {

enum class Glyphs { unicode, ascii };

// What the locale of the environment can show.
Glyphs locale_glyphs();

// The last `width` values, the least of them the lowest glyph and the largest the highest; of equal values the lowest.
// What is not finite shows as '!'.
std::string sparkline(const std::deque<double>& values, std::size_t width, Glyphs glyphs);

}  // namespace headrace::client
