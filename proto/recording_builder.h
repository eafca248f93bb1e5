// Gathers a recording's index while its chunks are met, in the order of the file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "proto/recording_chunk.h"
#include "proto/recording_index.h"

namespace headrace::proto::recording {

class IndexBuilder {
  public:
    explicit IndexBuilder(ChunkLoader& loader) : loader_(loader) {}

    // Takes frames, events and samples of probes of a chunk. Damage is counted; an error means that the file cannot be
    // read.
    Status take_chunk(std::uint64_t offset, std::uint64_t length);
    bool take_metadata(mcap::ByteView content);  // false: damaged
    void add_frame(const FrameEntry& entry) { index_.frames.push_back(entry); }
    void add_probes(const ChunkPlace& place) { index_.probes.push_back(place); }
    void set_gaps(std::uint64_t gaps) { index_.summary.gaps = gaps; }
    void skip(std::uint64_t bytes) { index_.summary.damaged_bytes += bytes; }

    std::size_t frame_count() const { return index_.frames.size(); }
    std::optional<std::uint64_t> end_number(const std::string& key) const;  // from the metadata at the end
    Index finish(bool is_complete);

  private:
    void take_frame(const FrameEntry& entry, const mcap::Message& message);
    void take_event(const mcap::Message& message);

    ChunkLoader& loader_;
    Index index_;
    mcap::StringMap end_;
    std::uint64_t last_seq_{0};
};

}  // namespace headrace::proto::recording
