// The end of a recording: what lets a reader find every chunk without reading them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "proto/mcap.h"
#include "proto/recording_layout.h"

namespace headrace::proto::recording {

// A chunk of ours holds one message and is followed by one message index record.
struct ChunkEntry {
    std::uint16_t channel{};
    std::uint64_t log_time{};      // [ns]
    std::uint64_t offset{};        // of the chunk record
    std::uint64_t length{};        // of the chunk record
    std::uint64_t records_size{};  // as stored
    std::uint64_t uncompressed_size{};
};
inline constexpr std::uint64_t kMessageIndexBytes = mcap::kRecordHead + 2 + 4 + 16;

struct MetadataEntry {
    std::string_view name;
    std::uint64_t offset{};
    std::uint64_t length{};
};

struct SummaryInput {
    std::span<const ChunkEntry> chunks;
    std::span<const MetadataEntry> metadata;
    std::string_view compression;  // of the chunks
    std::uint64_t file_size{};     // the summary is appended here
};

void put_schema(mcap::Bytes& out, const Channel& channel);
void put_channel(mcap::Bytes& out, const Channel& channel);

// Everything behind the last chunk: data end, summary, summary offsets, footer, magic.
mcap::Bytes make_summary(const SummaryInput& input);

}  // namespace headrace::proto::recording
