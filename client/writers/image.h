// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "proto/result.h"

namespace headrace::client {

struct Rgb {
    std::uint8_t r{}, g{}, b{};
    constexpr bool operator==(const Rgb&) const = default;
};

// Opaque pixels, rows from the top, each 0xFFRRGGBB.
struct Image {
    int width{}, height{};  // [px]
    std::vector<std::uint32_t> pixels;

    Image() = default;
    Image(int w, int h, Rgb fill) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, packed(fill)) {}

    static constexpr std::uint32_t packed(Rgb c) {
        return 0xFF000000u | std::uint32_t{c.r} << 16 | std::uint32_t{c.g} << 8 | c.b;
    }
    std::uint32_t* row(int y) { return pixels.data() + static_cast<std::size_t>(y) * width; }
    const std::uint32_t* row(int y) const { return pixels.data() + static_cast<std::size_t>(y) * width; }
    Rgb at(int x, int y) const {
        const std::uint32_t p = row(y)[x];
        return {static_cast<std::uint8_t>(p >> 16), static_cast<std::uint8_t>(p >> 8), static_cast<std::uint8_t>(p)};
    }
};

// Copies `source` into `target` with its top left corner at x, y. Precondition: it fits.
void paste(const Image& source, Image& target, int x, int y);

// Errors: file_error.
proto::Status write_png(const std::filesystem::path& file, const Image& image);

}  // namespace headrace::client
