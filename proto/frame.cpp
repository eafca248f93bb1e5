#include "proto/frame.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <optional>

#include "proto/version.h"

namespace headrace::proto {

static_assert(std::endian::native == std::endian::little, "frames are copied, not byte-swapped");
static_assert(offsetof(FrameHeader, version) == 24 && offsetof(FrameHeader, session) == 32);
static_assert(offsetof(FrameHeader, time) == 56 && offsetof(FrameHeader, total_bytes) == 80);
static_assert(offsetof(FrameHeader, crc) == 124 && offsetof(FrameField, offset) == 32);

namespace {

constexpr std::uint16_t kRaw = 0;  // FrameField::encoding

std::size_t aligned(std::size_t offset) {
    return (offset + kFrameAlignment - 1) / kFrameAlignment * kFrameAlignment;
}

std::size_t table_end(std::size_t field_count) {
    return sizeof(FrameHeader) + field_count * sizeof(FrameField);
}

// The CRC leaves out its own four bytes at 124.
std::uint32_t frame_crc(std::span<const std::byte> message) {
    const auto* bytes = reinterpret_cast<const Bytef*>(message.data());
    const uLong head = crc32_z(0, bytes, offsetof(FrameHeader, crc));
    return static_cast<std::uint32_t>(crc32_z(head, bytes + sizeof(FrameHeader), message.size() - sizeof(FrameHeader)));
}

template <std::size_t size>
void set_text(char (&target)[size], std::string_view text) {
    std::memcpy(target, text.data(), std::min(text.size(), size));
}

template <std::size_t size>
std::string_view text_of(const char (&source)[size]) {
    return {source, static_cast<std::size_t>(std::find(source, source + size, '\0') - source)};
}

Error frame_error(std::size_t offset, const std::string& what) {
    return {ErrorCode::parse_error, "frame, byte " + std::to_string(offset) + ": " + what, "", ""};
}

// What the header says about itself, before the CRC vouches for the rest.
std::optional<Error> check_header(const FrameHeader& header, std::size_t message_size) {
    if (std::memcmp(header.magic, kFrameMagic, sizeof(header.magic)) != 0)
        return frame_error(offsetof(FrameHeader, magic), "no frame begins here, its mark HRFRAME1 is missing");
    if (header.version != kFrameVersion)
        return frame_error(offsetof(FrameHeader, version), "layout version " + std::to_string(header.version) +
                                                               ", this program reads version " +
                                                               std::to_string(kFrameVersion));
    if (header.total_bytes != message_size)
        return frame_error(offsetof(FrameHeader, total_bytes), "the frame has " + std::to_string(header.total_bytes) +
                                                                   " bytes, " + std::to_string(message_size) +
                                                                   " are here");
    return std::nullopt;
}

// What remains to be wrong where the CRC is right: a writer's mistake, or intent.
std::optional<Error> check_content(const FrameHeader& header, std::size_t message_size) {
    if (header.dimensions != 2 && header.dimensions != 3)
        return frame_error(offsetof(FrameHeader, dimensions), "dimensions must be 2 or 3");
    if (header.field_count > (message_size - sizeof(FrameHeader)) / sizeof(FrameField))
        return frame_error(offsetof(FrameHeader, field_count), "the field table is longer than the frame");
    if (!std::isfinite(header.time)) return frame_error(offsetof(FrameHeader, time), "the time is not finite");
    if (!std::isfinite(header.wall_clock))
        return frame_error(offsetof(FrameHeader, wall_clock), "the wall clock is not finite");
    return std::nullopt;
}

bool is_type_of(const FieldInfo& info, std::string_view dtype) {
    return info.is_integer ? dtype == "<u4" : dtype == "<f4" || dtype == "<f8";
}

// The dtype constant that outlives the message.
std::string_view lasting(std::string_view dtype) {
    for (std::string_view known : {"<u4", "<f4", "<f8"})
        if (known == dtype) return known;
    return {};
}

// One table entry as a view of its array; nothing for a field this program does not know.
Result<std::optional<FrameColumn>> read_entry(std::span<const std::byte> message, const FrameHeader& header,
                                              std::size_t entry) {
    const std::size_t at = table_end(entry);
    FrameField field;
    std::memcpy(&field, message.data() + at, sizeof(field));
    const auto wrong = [at](std::size_t member, const std::string& what) { return frame_error(at + member, what); };

    if (field.offset % kFrameAlignment != 0 || field.offset < table_end(header.field_count) ||
        field.offset > message.size())
        return wrong(offsetof(FrameField, offset), "the array's offset is outside the frame or not a multiple of 64");
    if (field.bytes > message.size() - field.offset)
        return wrong(offsetof(FrameField, bytes), "the array reaches beyond the frame's end");

    const std::optional<Field> known = find_field(text_of(field.name));
    if (!known) return std::optional<FrameColumn>{};

    const FieldInfo& info = field_info(*known);
    const std::string_view dtype = lasting(text_of(field.dtype));
    if (!is_type_of(info, dtype)) return wrong(offsetof(FrameField, dtype), "no dtype of this field");
    if (field.components != (info.is_vector ? header.dimensions : 1))
        return wrong(offsetof(FrameField, components), "wrong number of components for this field");
    if (field.encoding != kRaw) return wrong(offsetof(FrameField, encoding), "unknown encoding");
    if (field.scale != 1.0 || field.bias != 0.0)
        return wrong(offsetof(FrameField, scale), "raw values have scale 1 and bias 0");
    // Divided, not multiplied: a count near 2^64 must not wrap around to fit.
    const std::size_t row_bytes = field.components * dtype_size(dtype);
    if (field.bytes % row_bytes != 0 || field.bytes / row_bytes != header.particle_count)
        return wrong(offsetof(FrameField, bytes), "the array's size does not match the particle count");
    return std::optional(FrameColumn{*known, dtype, field.components, message.subspan(field.offset, field.bytes)});
}

template <class T>
double load(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof(value));  // a received buffer need not be aligned
    return static_cast<double>(value);
}

}  // namespace

std::size_t dtype_size(std::string_view dtype) {
    if (dtype == "<u4" || dtype == "<f4") return 4;
    return dtype == "<f8" ? 8 : 0;
}

std::size_t frame_size(std::span<const FrameColumn> columns) {
    std::size_t end = table_end(columns.size());
    for (const FrameColumn& column : columns) end = aligned(end) + column.bytes.size();
    return end;
}

void encode_frame(const FrameInfo& info, std::span<const FrameColumn> columns, std::span<std::byte> out) {
    assert(out.size() == frame_size(columns));
    assert(info.topic.size() < kTopicBytes);
    FrameHeader header{};
    set_text(header.topic, std::string_view(info.topic).substr(0, kTopicBytes - 1));
    std::memcpy(header.magic, kFrameMagic, sizeof(header.magic));
    header.version = kFrameVersion;
    header.dimensions = static_cast<std::uint16_t>(info.dimensions);
    header.field_count = static_cast<std::uint32_t>(columns.size());
    header.session = info.session;
    header.seq = info.seq;
    header.step = info.step;
    header.time = info.time;
    header.wall_clock = info.wall_clock;
    header.particle_count = info.particle_count;
    header.total_bytes = out.size();
    std::memcpy(out.data(), &header, sizeof(header));

    std::size_t end = table_end(columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const FrameColumn& column = columns[k];
        assert(column.bytes.size() == info.particle_count * column.components * dtype_size(column.dtype));
        FrameField field{};
        set_text(field.name, field_info(column.field).name);
        set_text(field.dtype, column.dtype);
        field.components = static_cast<std::uint16_t>(column.components);
        field.encoding = kRaw;
        field.offset = aligned(end);
        field.bytes = column.bytes.size();
        field.scale = 1.0;
        std::memcpy(out.data() + table_end(k), &field, sizeof(field));

        std::memset(out.data() + end, 0, field.offset - end);
        if (!column.bytes.empty()) std::memcpy(out.data() + field.offset, column.bytes.data(), column.bytes.size());
        end = field.offset + column.bytes.size();
    }

    header.crc = frame_crc(out);
    std::memcpy(out.data(), &header, sizeof(header));
}

const FrameColumn* FrameView::find(Field field) const {
    for (const FrameColumn& column : columns)
        if (column.field == field) return &column;
    return nullptr;
}

double FrameView::value(const FrameColumn& column, std::size_t row, int component) {
    const std::size_t size = dtype_size(column.dtype);
    const std::byte* at = column.bytes.data() + (row * column.components + component) * size;
    if (column.dtype == "<u4") return load<std::uint32_t>(at);
    return size == 4 ? load<float>(at) : load<double>(at);
}

Result<FrameView> decode_frame(std::span<const std::byte> message) {
    if (message.size() < sizeof(FrameHeader))
        return frame_error(message.size(), "the frame ends within its header of 128 bytes");
    FrameHeader header;
    std::memcpy(&header, message.data(), sizeof(header));
    if (auto error = check_header(header, message.size())) return *error;
    if (header.crc != frame_crc(message))
        return frame_error(offsetof(FrameHeader, crc), "the CRC does not match: the frame is damaged");
    if (auto error = check_content(header, message.size())) return *error;

    FrameView view;
    view.info = {std::string(text_of(header.topic)),
                 header.dimensions,
                 header.session,
                 header.seq,
                 header.step,
                 header.time,
                 header.wall_clock,
                 header.particle_count};
    for (std::size_t k = 0; k < header.field_count; ++k) {
        auto column = read_entry(message, header, k);
        if (!column) return column.error();
        if (!*column) continue;
        if (view.find((*column)->field)) return frame_error(table_end(k), "the field appears twice");
        view.columns.push_back(**column);
    }
    return view;
}

}  // namespace headrace::proto
