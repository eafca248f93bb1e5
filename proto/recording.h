// Recordings: MCAP files (https://mcap.dev/spec) with one chunk per frame. Written in place, append-only: a file cut at
// any byte still yields every complete chunk. Used by server and client alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "proto/frame.h"
#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::proto {

struct RecordingOptions {
    Compression compression{Compression::none};  // of each chunk
    bool overwrite{false};
};

// What is known when a recording starts; stored as MCAP metadata right after the header, so that a truncated file has
// it too.
struct RecordingMetadata {
    std::string scene_json;    // the scene document as loaded
    std::string objects_json;  // array of ObjectDesc: the objects when the recording began
    std::string session;       // of the server
    std::string program;       // "headraced 0.1.0"
    std::string strategy;      // how the model summed its pairs, as in sim.status; empty: not known
};

// Owner: one thread. Writes go to the kernel at the end of each chunk, so a killed process loses nothing it returned
// from; a failed write (disk full) is an error naming the file, and the writer stays closed.
class RecordingWriter {
  public:
    static Result<std::unique_ptr<RecordingWriter>> create(const std::filesystem::path& file,
                                                           const RecordingMetadata& metadata,
                                                           const RecordingOptions& options);
    ~RecordingWriter();  // finishes if finish() was not called

    Status write_frame(std::span<const std::byte> frame);      // wire bytes, verbatim; log_time = frame time in ns
    Status write_event(const Event& event);                    // JSON channel "events"
    Status write_command(std::string_view json, double time);  // JSON channel "commands"
    // JSON channel "probes". Each sample comes with its columns; they are written when they are new.
    Status write_probes(const ProbeSamples& samples);
    Status finish();  // summary and footer; idempotent

    std::uint64_t frames() const;
    std::uint64_t gaps() const;  // jumps in the frames' sequence numbers
    std::uint64_t bytes() const;

  private:
    struct Impl;
    explicit RecordingWriter(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

struct RecordingSummary {
    RecordingMetadata metadata;
    bool complete{};                // footer present
    std::uint64_t damaged_bytes{};  // tail or regions that were skipped
    std::uint64_t frames{};
    std::uint64_t gaps{};
    double first_time{}, last_time{};  // [s]
};

// Reads any file of ours, whole or cut off; memory is bounded by one chunk.
class RecordingReader {
  public:
    static Result<std::unique_ptr<RecordingReader>> open(const std::filesystem::path& file);
    ~RecordingReader();

    const RecordingSummary& summary() const;   // from one scan at open (chunk headers and indexes, not payloads)
    const std::vector<Event>& events() const;  // ascending in time
    // Samples of probes in the order of the file, each with its columns. Stops at the first error: file_error,
    // parse_error naming file and byte offset.
    Status read_probes(const std::function<void(const ProbeSamples&)>& visit);
    std::size_t frame_count() const;
    double frame_time(std::size_t index) const;  // [s]
    // Bytes stay valid until the next call. Errors: file_error, parse_error (bad CRC) naming file and byte offset.
    Result<FrameView> read_frame(std::size_t index);

  private:
    struct Impl;
    explicit RecordingReader(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace headrace::proto
