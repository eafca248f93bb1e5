// The binary frame: one message part, little-endian, that is streamed, recorded and parsed alike.
// Byte table and a NumPy parser: proto/README.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "proto/fields.h"
#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::proto {

inline constexpr std::size_t kTopicBytes = 16;
inline constexpr char kFrameMagic[9] = "HRFRAME1";
inline constexpr std::size_t kFrameAlignment = 64;  // field arrays start at multiples of it from the message's start

// Bytes 0..127 of a frame.
struct FrameHeader {
    char topic[kTopicBytes];       //   0  NUL-padded
    char magic[8];                 //  16  "HRFRAME1"
    std::uint16_t version;         //  24  kFrameVersion
    std::uint16_t dimensions;      //  26  2 or 3
    std::uint32_t field_count;     //  28  entries in the field table that follows the header
    std::uint64_t session;         //  32  of the server
    std::uint64_t seq;             //  40  within the stream, from 1, gap-free
    std::uint64_t step;            //  48
    double time;                   //  56  [s] simulated
    double wall_clock;             //  64  [s] since 1970-01-01 UTC, at capture
    std::uint64_t particle_count;  //  72
    std::uint64_t total_bytes;     //  80  of the whole message
    std::uint8_t reserved[36];     //  88  zero
    std::uint32_t crc;             // 124  CRC-32 (zlib) of bytes 0..123 followed by bytes 128..end
};
static_assert(sizeof(FrameHeader) == 128);

// One entry of the field table, from byte 128.
struct FrameField {
    char name[16];             //  0  NUL-padded
    char dtype[8];             // 16  NumPy dtype string such as "<f4", NUL-padded
    std::uint16_t components;  // 24  per particle
    std::uint16_t encoding;    // 26  0: raw
    std::uint32_t reserved;    // 28  zero
    std::uint64_t offset;      // 32  from the message's start
    std::uint64_t bytes;       // 40
    double scale;              // 48  value = bias + scale * stored
    double bias;               // 56
};
static_assert(sizeof(FrameField) == 64);

// What a frame says besides its arrays.
struct FrameInfo {
    std::string topic;
    int dimensions{3};
    std::uint64_t session{};
    std::uint64_t seq{};
    std::uint64_t step{};
    double time{};        // [s]
    double wall_clock{};  // [s]
    std::uint64_t particle_count{};
};

// One field's values as they travel: particle_count rows of `components` values, rows ascending by particle id.
struct FrameColumn {
    Field field{};
    std::string_view dtype;  // "<u4", "<f4" or "<f8"
    int components{1};
    std::span<const std::byte> bytes;  // a view; the owner outlives it
};

std::size_t dtype_size(std::string_view dtype);  // 0 for a dtype that frames do not use

// Bytes of the message that encode_frame writes.
std::size_t frame_size(std::span<const FrameColumn> columns);

// Writes a whole frame; `out` has frame_size(columns) bytes. Padding bytes are zero.
void encode_frame(const FrameInfo& info, std::span<const FrameColumn> columns, std::span<std::byte> out);

// A decoded frame: views into the message it was decoded from.
struct FrameView {
    FrameInfo info;
    std::vector<FrameColumn> columns;

    const FrameColumn* find(Field field) const;
    // Value of one component as double; any dtype. Precondition: row < particle_count, component < components.
    static double value(const FrameColumn& column, std::size_t row, int component);
};

// Checks everything (magic, version, sizes, offsets, CRC) before a byte of an array is believed. Unknown fields are
// skipped. Errors: parse_error naming the byte offset.
Result<FrameView> decode_frame(std::span<const std::byte> message);

}  // namespace headrace::proto
