#include "proto/recording_summary.h"

#include <algorithm>
#include <array>
#include <limits>

namespace headrace::proto::recording {

using mcap::Bytes;
using mcap::ByteView;
using mcap::Op;
using mcap::OpenRecord;

namespace {

constexpr std::array kChannels{kFrames, kEvents, kCommands, kProbes};

// A run of records of one kind; the format wants summary records grouped.
struct Group {
    Op op;
    std::size_t start;
};

void put_metadata_indexes(Bytes& out, const SummaryInput& input) {
    for (const MetadataEntry& entry : input.metadata) {
        const OpenRecord record(out, Op::metadata_index);
        mcap::put_u64(out, entry.offset);
        mcap::put_u64(out, entry.length);
        mcap::put_string(out, entry.name);
    }
}

void put_chunk_indexes(Bytes& out, const SummaryInput& input) {
    for (const ChunkEntry& chunk : input.chunks) {
        mcap::ChunkIndex index;
        index.start_time = index.end_time = chunk.log_time;
        index.offset = chunk.offset;
        index.length = chunk.length;
        index.message_indexes = {{chunk.channel, chunk.offset + chunk.length}};
        index.message_index_length = kMessageIndexBytes;
        index.compression = input.compression;
        index.records_size = chunk.records_size;
        index.uncompressed_size = chunk.uncompressed_size;
        mcap::put_chunk_index(out, index);
    }
}

void put_statistics(Bytes& out, const SummaryInput& input) {
    std::array<std::uint64_t, kChannels.size()> counts{};
    std::uint64_t first = input.chunks.empty() ? 0 : std::numeric_limits<std::uint64_t>::max();
    std::uint64_t last = 0;
    for (const ChunkEntry& chunk : input.chunks) {
        ++counts[chunk.channel - 1u];
        first = std::min(first, chunk.log_time);
        last = std::max(last, chunk.log_time);
    }
    const OpenRecord record(out, Op::statistics);
    mcap::put_u64(out, input.chunks.size());  // messages
    mcap::put_u16(out, kChannels.size());     // schemas
    mcap::put_u32(out, kChannels.size());
    mcap::put_u32(out, 0);  // attachments
    mcap::put_u32(out, static_cast<std::uint32_t>(input.metadata.size()));
    mcap::put_u32(out, static_cast<std::uint32_t>(input.chunks.size()));
    mcap::put_u64(out, first);
    mcap::put_u64(out, last);
    mcap::put_u32(out, kChannels.size() * 10);  // bytes of the map from channel to message count
    for (const Channel& channel : kChannels) {
        mcap::put_u16(out, channel.id);
        mcap::put_u64(out, counts[channel.id - 1u]);
    }
}

}  // namespace

void put_schema(Bytes& out, const Channel& channel) {
    const OpenRecord record(out, Op::schema);
    mcap::put_u16(out, channel.id);
    mcap::put_string(out, channel.schema_name);
    mcap::put_string(out, channel.schema_encoding);
    mcap::put_string(out, channel.schema);
}

void put_channel(Bytes& out, const Channel& channel) {
    const OpenRecord record(out, Op::channel);
    mcap::put_u16(out, channel.id);
    mcap::put_u16(out, channel.id);  // of its schema
    mcap::put_string(out, channel.topic);
    mcap::put_string(out, channel.message_encoding);
    mcap::put_map(out, {});
}

Bytes make_summary(const SummaryInput& input) {
    Bytes out;
    {
        const OpenRecord record(out, Op::data_end);
        mcap::put_u32(out, 0);  // no CRC over the whole data section: each chunk has its own
    }
    const std::size_t start = out.size();

    std::vector<Group> groups;
    const auto begin_group = [&](Op op) { groups.push_back({op, out.size()}); };
    begin_group(Op::schema);
    for (const Channel& channel : kChannels) put_schema(out, channel);
    begin_group(Op::channel);
    for (const Channel& channel : kChannels) put_channel(out, channel);
    begin_group(Op::metadata_index);
    put_metadata_indexes(out, input);
    if (!input.chunks.empty()) begin_group(Op::chunk_index);
    put_chunk_indexes(out, input);
    begin_group(Op::statistics);
    put_statistics(out, input);

    const std::size_t groups_end = out.size();
    for (std::size_t k = 0; k < groups.size(); ++k) {
        const std::size_t end = k + 1 < groups.size() ? groups[k + 1].start : groups_end;
        const OpenRecord record(out, Op::summary_offset);
        mcap::put_u8(out, static_cast<std::uint8_t>(groups[k].op));
        mcap::put_u64(out, input.file_size + groups[k].start);
        mcap::put_u64(out, end - groups[k].start);
    }

    mcap::put_head(out, Op::footer, mcap::kFooterBytes);
    mcap::put_u64(out, input.file_size + start);
    mcap::put_u64(out, input.file_size + groups_end);
    mcap::put_u32(out, mcap::crc32(ByteView(out).subspan(start)));
    mcap::put_bytes(out, {mcap::kMagic, mcap::kMagicBytes});
    return out;
}

}  // namespace headrace::proto::recording
