#include "proto/recording_chunk.h"

#include <zstd.h>

#include <algorithm>

namespace headrace::proto::recording {

using mcap::ByteView;

namespace {

constexpr std::uint64_t kMostUnpacked = std::uint64_t{4} << 30;  // bytes; frames of 10^7 particles need 1 GB

// Grows without ever shrinking: the same memory serves frame after frame.
std::span<std::byte> room(mcap::Bytes& buffer, std::size_t size) {
    if (buffer.size() < size) buffer.resize(size);
    return std::span(buffer).first(size);
}

}  // namespace

Error damage(const File& file, std::uint64_t offset, const std::string& what) {
    return {ErrorCode::parse_error, file.path().string() + ", byte " + std::to_string(offset) + ": " + what,
            file.path().string(), ""};
}

struct ChunkLoader::Decompressor {
    ZSTD_DCtx* context{ZSTD_createDCtx()};
    ~Decompressor() { ZSTD_freeDCtx(context); }
};

ChunkLoader::ChunkLoader(const File& file) : file_(file) {}

ChunkLoader::~ChunkLoader() = default;

Result<ByteView> ChunkLoader::load(std::uint64_t offset, std::uint64_t length) {
    const std::span<std::byte> bytes = room(record_, length);
    if (Status status = file_.read(offset, bytes); !status) return status.error();
    mcap::Cursor cursor(bytes);
    const auto record = mcap::next_record(cursor);
    if (!record || record->op != mcap::Op::chunk || !cursor.done())
        return damage(file_, offset, "no chunk begins here");
    const auto head = mcap::read_chunk_head(record->content, record->content.size());
    if (!head) return damage(file_, offset, "the chunk's head is damaged");

    ByteView records = record->content.subspan(head->size());
    if (!head->compression.empty()) {
        if (!decompress(records, head->uncompressed_size))
            return damage(file_, offset, "the chunk cannot be decompressed");
        records = ByteView(unpacked_).first(head->uncompressed_size);
    }
    if (mcap::crc32(records) != head->uncompressed_crc)
        return damage(file_, offset, "the chunk's CRC does not match: it is damaged");
    return records;
}

// Memory grows with what really comes out: the size that a chunk claims is not believed beforehand.
bool ChunkLoader::decompress(ByteView packed, std::uint64_t size) {
    if (size > kMostUnpacked) return false;
    if (!decompressor_) decompressor_ = std::make_unique<Decompressor>();
    ZSTD_DCtx_reset(decompressor_->context, ZSTD_reset_session_only);
    ZSTD_inBuffer in{packed.data(), packed.size(), 0};
    std::size_t done = 0;
    std::size_t granted =
        std::min<std::size_t>(size, std::max<std::size_t>(unpacked_.size(), 4 * packed.size() + 1024));
    while (true) {
        const std::size_t taken = in.pos;
        const std::span<std::byte> target = room(unpacked_, granted);
        ZSTD_outBuffer out{target.data(), target.size(), done};
        const std::size_t left = ZSTD_decompressStream(decompressor_->context, &out, &in);
        if (ZSTD_isError(left)) return false;
        if (left == 0) return out.pos == size && in.pos == in.size;
        const bool can_grow = out.pos == granted && granted < size;
        if (!can_grow && out.pos == done && in.pos == taken) return false;  // cut off, or more than it claims
        done = out.pos;
        if (can_grow) granted = std::min<std::size_t>(size, 2 * granted);
    }
}

}  // namespace headrace::proto::recording
