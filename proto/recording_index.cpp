#include "proto/recording_index.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "proto/recording_builder.h"
#include "proto/recording_layout.h"

namespace headrace::proto::recording {

using mcap::Bytes;
using mcap::ByteView;
using mcap::Cursor;
using mcap::Op;

namespace {

// The summary section, when footer and CRC are right.
Result<std::optional<Bytes>> read_summary(const File& file, std::uint64_t& summary_start) {
    constexpr std::size_t kEnd = mcap::kRecordHead + mcap::kFooterBytes + mcap::kMagicBytes;
    const std::optional<Bytes> none;
    if (file.size() < mcap::kMagicBytes + kEnd) return none;
    std::array<std::byte, kEnd> end;
    const std::uint64_t footer_at = file.size() - kEnd;
    if (Status status = file.read(footer_at, end); !status) return status.error();

    Cursor cursor(end);
    const auto footer = mcap::next_record(cursor);
    if (!footer || footer->op != Op::footer || footer->content.size() != mcap::kFooterBytes) return none;
    if (std::memcmp(cursor.rest().data(), mcap::kMagic, mcap::kMagicBytes) != 0) return none;
    Cursor fields(footer->content);
    summary_start = fields.u64();
    fields.u64();  // where the summary offsets start: the summary is read as a whole
    const std::uint32_t crc = fields.u32();
    if (summary_start < mcap::kMagicBytes || summary_start > footer_at) return none;

    // The CRC covers the footer up to itself.
    Bytes summary(footer_at - summary_start + mcap::kRecordHead + 16);
    if (Status status = file.read(summary_start, summary); !status) return status.error();
    if (mcap::crc32(summary) != crc) return none;
    summary.resize(footer_at - summary_start);
    return std::optional(std::move(summary));
}

struct Range {
    std::uint64_t begin{mcap::kMagicBytes};
    std::uint64_t end{};

    bool holds(std::uint64_t offset, std::uint64_t length) const {
        return offset >= begin && offset <= end && length <= end - offset;
    }
};

// Takes one record of the summary; false when the summary cannot be trusted. `data` is the part of the file that
// chunks may still lie in: one behind the other, so that no index makes us read a chunk twice.
Result<bool> take_summary_record(const File& file, const mcap::Record& record, Range& data, IndexBuilder& builder) {
    if (record.op == Op::chunk_index) {
        const auto chunk = mcap::read_chunk_index(record.content);
        if (!chunk || !data.holds(chunk->offset, chunk->length)) return false;
        // One message per chunk: then the chunk's time is the message's.
        if (chunk->message_indexes.size() != 1 || chunk->start_time != chunk->end_time) return false;
        data.begin = chunk->offset + chunk->length;
        const std::uint16_t channel = chunk->message_indexes.begin()->first;
        if (channel == kFrames.id) builder.add_frame({chunk->offset, chunk->length, 0, chunk->start_time});
        if (channel == kProbes.id) builder.add_probes({chunk->offset, chunk->length});
        if (channel == kEvents.id)
            if (Status status = builder.take_chunk(chunk->offset, chunk->length); !status) return status.error();
    }
    if (record.op == Op::metadata_index) {
        Cursor fields(record.content);
        const std::uint64_t offset = fields.u64();
        const std::uint64_t length = fields.u64();
        if (!fields.ok() || !Range{mcap::kMagicBytes, data.end}.holds(offset, length) || length > kMostMetadata)
            return false;
        Bytes bytes(length);
        if (Status status = file.read(offset, bytes); !status) return status.error();
        Cursor cursor(bytes);
        const auto metadata = mcap::next_record(cursor);
        return metadata && metadata->op == Op::metadata && builder.take_metadata(metadata->content);
    }
    return true;
}

Result<std::optional<Index>> index_from_summary(const File& file, ChunkLoader& loader) {
    const std::optional<Index> none;
    Range data;
    auto summary = read_summary(file, data.end);
    if (!summary) return summary.error();
    if (!*summary) return none;

    IndexBuilder builder(loader);
    Cursor cursor(**summary);
    while (!cursor.done()) {
        const auto record = mcap::next_record(cursor);
        if (!record) return none;
        auto taken = take_summary_record(file, *record, data, builder);
        if (!taken) return taken.error();
        if (!*taken) return none;
    }
    const auto gaps = builder.end_number("gaps");
    if (!gaps || builder.end_number("frames") != builder.frame_count()) return none;
    builder.set_gaps(*gaps);
    return std::optional(builder.finish(true));
}

}  // namespace

Result<Index> read_index(const File& file, ChunkLoader& loader) {
    std::array<std::byte, mcap::kMagicBytes> magic;
    if (file.size() < magic.size()) return damage(file, 0, "no recording: shorter than the mark of an MCAP file");
    if (Status status = file.read(0, magic); !status) return status.error();
    if (std::memcmp(magic.data(), mcap::kMagic, magic.size()) != 0)
        return damage(file, 0, "no recording: the mark of an MCAP file is missing");

    Bytes begin(std::min<std::uint64_t>(file.size() - magic.size(), 4096));
    if (Status status = file.read(magic.size(), begin); !status) return status.error();
    Cursor cursor(begin);
    if (const auto header = mcap::next_record(cursor); header && header->op == Op::header) {
        Cursor fields(header->content);
        const std::string profile = fields.string();
        if (fields.ok() && profile != kProfile)
            return damage(file, magic.size(), "an MCAP file, but none of headrace: its profile is `" + profile + "`");
    }

    auto index = index_from_summary(file, loader);
    if (!index) return index.error();
    if (*index) return std::move(**index);
    return index_by_scan(file, loader);
}

}  // namespace headrace::proto::recording
