// Numbers of any type and byte order that files store them in.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace headrace::scene {

enum class NumberType { i1, u1, i2, u2, i4, u4, i8, u8, f4, f8 };

constexpr std::size_t size_of(NumberType type) {
    switch (type) {
        case NumberType::i1:
        case NumberType::u1:
            return 1;
        case NumberType::i2:
        case NumberType::u2:
            return 2;
        case NumberType::i4:
        case NumberType::u4:
        case NumberType::f4:
            return 4;
        default:
            return 8;
    }
}

// A number as it lies in the file. Precondition: there are size_of(type) bytes.
inline double read_number(NumberType type, std::endian order, const char* bytes) {
    const auto as = [&](auto value) {
        std::array<char, sizeof value> own;
        std::copy_n(bytes, own.size(), own.begin());
        if (order != std::endian::native) std::reverse(own.begin(), own.end());
        std::memcpy(&value, own.data(), own.size());
        return static_cast<double>(value);
    };
    switch (type) {
        case NumberType::i1:
            return as(std::int8_t{});
        case NumberType::u1:
            return as(std::uint8_t{});
        case NumberType::i2:
            return as(std::int16_t{});
        case NumberType::u2:
            return as(std::uint16_t{});
        case NumberType::i4:
            return as(std::int32_t{});
        case NumberType::u4:
            return as(std::uint32_t{});
        case NumberType::i8:
            return as(std::int64_t{});
        case NumberType::u8:
            return as(std::uint64_t{});
        case NumberType::f4:
            return as(float{});
        default:
            return as(double{});
    }
}

}  // namespace headrace::scene
