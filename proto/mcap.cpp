#include "proto/mcap.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace headrace::proto::mcap {

static_assert(std::endian::native == std::endian::little, "integers are copied, not byte-swapped");

namespace {

template <class T>
void put_number(Bytes& out, T value) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    out.insert(out.end(), bytes, bytes + sizeof(value));
}

}  // namespace

std::uint32_t crc32(ByteView bytes, std::uint32_t before) {
    // zlib takes a null pointer as the wish for the initial value.
    if (bytes.empty()) return before;
    return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void put_bytes(Bytes& out, std::string_view bytes) {
    const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
    out.insert(out.end(), begin, begin + bytes.size());
}

void put_u8(Bytes& out, std::uint8_t value) {
    put_number(out, value);
}

void put_u16(Bytes& out, std::uint16_t value) {
    put_number(out, value);
}

void put_u32(Bytes& out, std::uint32_t value) {
    put_number(out, value);
}

void put_u64(Bytes& out, std::uint64_t value) {
    put_number(out, value);
}

void put_string(Bytes& out, std::string_view text) {
    put_u32(out, static_cast<std::uint32_t>(text.size()));
    put_bytes(out, text);
}

void put_map(Bytes& out, const StringMap& map) {
    const std::size_t start = out.size();
    put_u32(out, 0);
    for (const auto& [key, value] : map) {
        put_string(out, key);
        put_string(out, value);
    }
    const auto length = static_cast<std::uint32_t>(out.size() - start - 4);
    std::memcpy(out.data() + start, &length, sizeof(length));
}

void put_head(Bytes& out, Op op, std::uint64_t length) {
    put_u8(out, static_cast<std::uint8_t>(op));
    put_u64(out, length);
}

OpenRecord::~OpenRecord() {
    const std::uint64_t length = out_.size() - start_ - kRecordHead;
    std::memcpy(out_.data() + start_ + 1, &length, sizeof(length));
}

ByteView Cursor::bytes(std::uint64_t count) {
    if (!ok_ || count > rest_.size()) {
        ok_ = false;
        rest_ = {};
        return {};
    }
    const ByteView front = rest_.first(count);
    rest_ = rest_.subspan(count);
    return front;
}

std::string Cursor::string() {
    const ByteView text = bytes(u32());
    return {reinterpret_cast<const char*>(text.data()), text.size()};
}

StringMap Cursor::map() {
    Cursor entries(bytes(u32()));
    StringMap map;
    while (!entries.done()) {
        std::string key = entries.string();
        map[std::move(key)] = entries.string();
    }
    ok_ = ok_ && entries.ok();
    return map;
}

std::optional<Record> next_record(Cursor& cursor) {
    Record record;
    record.op = static_cast<Op>(cursor.u8());
    record.content = cursor.bytes(cursor.u64());
    if (!cursor.ok()) return std::nullopt;
    return record;
}

std::optional<Message> read_message(ByteView content) {
    Cursor cursor(content);
    Message message;
    message.channel = cursor.u16();
    message.sequence = cursor.u32();
    message.log_time = cursor.u64();
    message.publish_time = cursor.u64();
    message.data = cursor.rest();
    if (!cursor.ok()) return std::nullopt;
    return message;
}

void put_chunk_head(Bytes& out, const ChunkHead& head) {
    put_head(out, Op::chunk, head.size() + head.records_size);
    put_u64(out, head.start_time);
    put_u64(out, head.end_time);
    put_u64(out, head.uncompressed_size);
    put_u32(out, head.uncompressed_crc);
    put_string(out, head.compression);
    put_u64(out, head.records_size);
}

std::optional<ChunkHead> read_chunk_head(ByteView begin, std::uint64_t length) {
    Cursor cursor(begin.first(std::min<std::size_t>(begin.size(), kChunkHeadMax)));
    ChunkHead head;
    head.start_time = cursor.u64();
    head.end_time = cursor.u64();
    head.uncompressed_size = cursor.u64();
    head.uncompressed_crc = cursor.u32();
    head.compression = cursor.string();
    head.records_size = cursor.u64();
    const bool is_plain = head.compression.empty() && head.records_size == head.uncompressed_size;
    const bool agrees = cursor.ok() && length >= head.size() && length - head.size() == head.records_size &&
                        head.start_time <= head.end_time && (is_plain || head.compression == "zstd");
    if (!agrees) return std::nullopt;
    return head;
}

void put_chunk_index(Bytes& out, const ChunkIndex& index) {
    const OpenRecord record(out, Op::chunk_index);
    put_u64(out, index.start_time);
    put_u64(out, index.end_time);
    put_u64(out, index.offset);
    put_u64(out, index.length);
    put_u32(out, static_cast<std::uint32_t>(index.message_indexes.size() * 10));
    for (const auto& [channel, offset] : index.message_indexes) {
        put_u16(out, channel);
        put_u64(out, offset);
    }
    put_u64(out, index.message_index_length);
    put_string(out, index.compression);
    put_u64(out, index.records_size);
    put_u64(out, index.uncompressed_size);
}

std::optional<ChunkIndex> read_chunk_index(ByteView content) {
    Cursor cursor(content);
    ChunkIndex index;
    index.start_time = cursor.u64();
    index.end_time = cursor.u64();
    index.offset = cursor.u64();
    index.length = cursor.u64();
    Cursor entries(cursor.bytes(cursor.u32()));
    while (!entries.done()) {
        const std::uint16_t channel = entries.u16();
        index.message_indexes[channel] = entries.u64();
    }
    index.message_index_length = cursor.u64();
    index.compression = cursor.string();
    index.records_size = cursor.u64();
    index.uncompressed_size = cursor.u64();
    if (!cursor.ok() || !entries.ok()) return std::nullopt;
    return index;
}

}  // namespace headrace::proto::mcap
