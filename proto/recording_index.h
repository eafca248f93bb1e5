// Where the frames of a recording are, and what it tells besides them.
#pragma once

#include <cstdint>
#include <vector>

#include "proto/recording.h"
#include "proto/recording_chunk.h"

namespace headrace::proto::recording {

struct FrameEntry {
    std::uint64_t chunk_offset{};
    std::uint64_t chunk_length{};
    std::uint32_t ordinal{};   // among the chunk's frames; ours have one
    std::uint64_t log_time{};  // [ns]
};

struct ChunkPlace {
    std::uint64_t offset{};
    std::uint64_t length{};
};

struct Index {
    RecordingSummary summary;
    std::vector<FrameEntry> frames;  // in the order of the file
    std::vector<Event> events;       // ascending in time
    std::vector<ChunkPlace> probes;  // chunks with samples of probes, in the order of the file
};

inline constexpr std::uint64_t kMostMetadata = std::uint64_t{64} << 20;  // [bytes] four times the largest request

inline double seconds(std::uint64_t nanoseconds) {
    return static_cast<double>(nanoseconds) * 1e-9;
}

// A finished file is believed up to its summary's CRC; its frames are checked when they are read. Any other file is
// read through and each chunk checked. Errors: file_error; parse_error when it is no recording at all.
Result<Index> read_index(const File& file, ChunkLoader& loader);

// The second way of the two.
Result<Index> index_by_scan(const File& file, ChunkLoader& loader);

// The data of a chunk's message of probes; empty when there is none.
mcap::ByteView find_probes(mcap::ByteView records);

// The data of the frame message at `ordinal`; empty when there is none.
mcap::ByteView find_frame(mcap::ByteView records, std::uint32_t ordinal);

}  // namespace headrace::proto::recording
