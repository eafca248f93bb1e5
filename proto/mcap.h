// The part of the MCAP container format (https://mcap.dev/spec) that recordings use: records as bytes, and back.
// Integers are little-endian; a record is opcode (1 byte), content length (8), content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace headrace::proto::mcap {

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;
using StringMap = std::map<std::string, std::string>;

inline constexpr char kMagic[9] = "\x89MCAP0\r\n";  // opens and closes the file
inline constexpr std::size_t kMagicBytes = 8;
inline constexpr std::size_t kRecordHead = 9;      // opcode and length
inline constexpr std::size_t kFooterBytes = 20;    // content of the footer record
inline constexpr std::size_t kMessageFields = 22;  // of a message record, before its data

enum class Op : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    statistics = 0x0B,
    metadata = 0x0C,
    metadata_index = 0x0D,
    summary_offset = 0x0E,
    data_end = 0x0F,
};

std::uint32_t crc32(ByteView bytes, std::uint32_t before = 0);  // `before`: CRC of the bytes that precede these

// ---- writing: each function appends to `out` ------------------------------------------------------------------------

void put_bytes(Bytes& out, std::string_view bytes);
void put_u8(Bytes& out, std::uint8_t value);
void put_u16(Bytes& out, std::uint16_t value);
void put_u32(Bytes& out, std::uint32_t value);
void put_u64(Bytes& out, std::uint64_t value);
void put_string(Bytes& out, std::string_view text);      // length in 4 bytes, then the text
void put_map(Bytes& out, const StringMap& map);          // length in 4 bytes, then keys and values
void put_head(Bytes& out, Op op, std::uint64_t length);  // of a record whose content follows

// Writes a record's head at once and its length when the content has been appended.
class OpenRecord {
  public:
    OpenRecord(Bytes& out, Op op) : out_(out), start_(out.size()) { put_head(out, op, 0); }
    ~OpenRecord();
    OpenRecord(const OpenRecord&) = delete;
    OpenRecord& operator=(const OpenRecord&) = delete;

  private:
    Bytes& out_;
    std::size_t start_;
};

// ---- reading --------------------------------------------------------------------------------------------------------

// Reads from bytes that cannot be trusted. After a read beyond the end everything yields zero and ok() is false.
class Cursor {
  public:
    explicit Cursor(ByteView bytes) : rest_(bytes) {}

    std::uint8_t u8() { return number<std::uint8_t>(); }
    std::uint16_t u16() { return number<std::uint16_t>(); }
    std::uint32_t u32() { return number<std::uint32_t>(); }
    std::uint64_t u64() { return number<std::uint64_t>(); }
    std::string string();
    StringMap map();
    ByteView bytes(std::uint64_t count);

    ByteView rest() const { return rest_; }
    bool ok() const { return ok_; }
    bool done() const { return rest_.empty(); }

  private:
    template <class T>
    T number() {
        const ByteView source = bytes(sizeof(T));
        T value{};
        if (source.size() == sizeof(T)) std::memcpy(&value, source.data(), sizeof(T));
        return value;
    }

    ByteView rest_;
    bool ok_{true};
};

struct Record {
    Op op{};
    ByteView content;
};
// The record at the cursor, which then stands behind it; nothing when it is incomplete.
std::optional<Record> next_record(Cursor& cursor);

struct Message {
    std::uint16_t channel{};
    std::uint32_t sequence{};
    std::uint64_t log_time{};      // [ns]
    std::uint64_t publish_time{};  // [ns]
    ByteView data;
};
std::optional<Message> read_message(ByteView content);

// The content of a chunk record up to its records.
struct ChunkHead {
    std::uint64_t start_time{}, end_time{};  // [ns]
    std::uint64_t uncompressed_size{};
    std::uint32_t uncompressed_crc{};
    std::string compression;  // "" or "zstd"
    std::uint64_t records_size{};

    std::size_t size() const { return 8 + 8 + 8 + 4 + 4 + compression.size() + 8; }
};
inline constexpr std::size_t kChunkHeadMax = 44;  // size() with "zstd"

void put_chunk_head(Bytes& out, const ChunkHead& head);  // with the record's head in front

// The head of a chunk whose record content is `length` bytes long and begins with `begin` (at least kChunkHeadMax
// bytes or all there are). Nothing unless length, sizes, times and compression agree with one another, which bytes
// that are no chunk do by chance once in 2^90.
std::optional<ChunkHead> read_chunk_head(ByteView begin, std::uint64_t length);

struct ChunkIndex {
    std::uint64_t start_time{}, end_time{};                  // [ns]
    std::uint64_t offset{}, length{};                        // of the whole chunk record
    std::map<std::uint16_t, std::uint64_t> message_indexes;  // channel: offset of its index record
    std::uint64_t message_index_length{};
    std::string compression;
    std::uint64_t records_size{}, uncompressed_size{};
};
void put_chunk_index(Bytes& out, const ChunkIndex& index);
std::optional<ChunkIndex> read_chunk_index(ByteView content);

}  // namespace headrace::proto::mcap
