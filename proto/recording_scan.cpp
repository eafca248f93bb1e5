// Index of a file that was cut off, is still growing, or is damaged: every chunk is read and checked.
#include <algorithm>
#include <array>
#include <optional>

#include "proto/recording_builder.h"

namespace headrace::proto::recording {

using mcap::Bytes;
using mcap::ByteView;
using mcap::Cursor;
using mcap::Op;

namespace {

constexpr std::size_t kWindow = std::size_t{1} << 20;  // [bytes] read at once in search of a chunk
constexpr std::size_t kLookAhead = mcap::kRecordHead + mcap::kChunkHeadMax;

// The offset of the next thing from `from` on that is shaped like a chunk and fits into the file. The shape is told by
// two lengths and two sizes that must agree, so a search through particle data does not find one by accident.
Result<std::optional<std::uint64_t>> find_chunk(const File& file, std::uint64_t from) {
    Bytes window;
    while (from < file.size()) {
        window.resize(std::min<std::uint64_t>(kWindow, file.size() - from));
        if (Status status = file.read(from, window); !status) return status.error();
        const bool is_last = from + window.size() == file.size();
        const std::size_t end = is_last ? window.size() : window.size() - kLookAhead + 1;
        for (std::size_t k = 0; k < end; ++k) {
            if (window[k] != static_cast<std::byte>(Op::chunk)) continue;
            Cursor cursor(ByteView(window).subspan(k + 1));
            const std::uint64_t length = cursor.u64();
            const std::uint64_t room = file.size() - from - k;
            if (!cursor.ok() || room < mcap::kRecordHead || length > room - mcap::kRecordHead) continue;
            if (mcap::read_chunk_head(cursor.rest(), length)) return std::optional(from + k);
        }
        from += end;
    }
    return std::optional<std::uint64_t>{};
}

// What stands at a position of the data section.
enum class Found { record, end, damage };

// Takes the record at `offset`; sets `length` to that of the whole record.
Result<Found> take_record(const File& file, std::uint64_t offset, IndexBuilder& builder, std::uint64_t& length) {
    std::array<std::byte, kLookAhead> buffer;
    const std::uint64_t room = file.size() - offset;
    const auto begin = std::span(buffer).first(std::min<std::uint64_t>(room, buffer.size()));
    if (Status status = file.read(offset, begin); !status) return status.error();
    Cursor cursor(begin);
    const auto op = static_cast<Op>(cursor.u8());
    const std::uint64_t content = cursor.u64();
    if (!cursor.ok() || content > room - mcap::kRecordHead) return Found::damage;
    length = mcap::kRecordHead + content;

    switch (op) {
        case Op::chunk: {
            if (!mcap::read_chunk_head(cursor.rest(), content)) return Found::damage;
            if (Status status = builder.take_chunk(offset, length); !status) return status.error();
            return Found::record;
        }
        case Op::message_index: {
            // Both lengths must agree: a damaged one would jump over good chunks.
            cursor.u16();
            return cursor.u32() + std::uint64_t{6} == content ? Found::record : Found::damage;
        }
        case Op::header:
        case Op::metadata: {
            if (content > kMostMetadata) return Found::damage;
            Bytes bytes(content);
            if (Status status = file.read(offset + mcap::kRecordHead, bytes); !status) return status.error();
            if (op == Op::metadata) return builder.take_metadata(bytes) ? Found::record : Found::damage;
            Cursor fields(bytes);
            fields.string();
            fields.string();
            return fields.ok() && fields.done() ? Found::record : Found::damage;
        }
        case Op::data_end:
            return content == 4 ? Found::end : Found::damage;
        default:
            return Found::damage;
    }
}

}  // namespace

Result<Index> index_by_scan(const File& file, ChunkLoader& loader) {
    IndexBuilder builder(loader);
    std::uint64_t offset = mcap::kMagicBytes;
    while (offset < file.size()) {
        std::uint64_t length = 0;
        auto found = take_record(file, offset, builder, length);
        if (!found) return found.error();
        if (*found == Found::record) {
            offset += length;
            continue;
        }
        if (*found == Found::end) {
            // What follows is a summary that is not whole.
            builder.skip(file.size() - offset - length);
            break;
        }
        auto next = find_chunk(file, offset + 1);
        if (!next) return next.error();
        const std::uint64_t resumed = next->value_or(file.size());
        builder.skip(resumed - offset);
        offset = resumed;
    }
    return builder.finish(false);
}

}  // namespace headrace::proto::recording
