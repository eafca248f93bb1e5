// A lossless stream into a recording on this side. Owner: one thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "client/connection.h"
#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::client {

struct RecordOptions {
    std::filesystem::path file;
    std::optional<proto::FieldSet> fields;  // absent: the scene's output fields
    proto::Precision precision{proto::Precision::f4};
    std::optional<double> interval;  // [s] simulated; absent (and no every_steps): the scene's output interval
    std::optional<std::int64_t> every_steps;
    bool overwrite{false};
};

class Recorder {
  public:
    // Opens file and stream; the first frame is the present state. The connection outlives the recorder.
    static proto::Result<std::unique_ptr<Recorder>> open(Connection& connection, const RecordOptions& options);
    ~Recorder();  // close()

    // Takes in what arrives until nothing more does, at most for `patience`. Error: file_error.
    proto::Status receive(std::chrono::milliseconds patience);
    // Writes the events since the last call into the file. Error: connection_failed; the stream's own failure.
    proto::Status take_events();
    // While a run goes on: takes the stream over on a new connection when it has been silent for long.
    proto::Status reattach_when_silent();

    // Frames later than this are not written. [s]
    void set_last_time(double time);

    // Ends the stream, takes in the frames still under way, completes the file; idempotent. An error tells what is
    // missing; the file is complete as far as it goes in any case.
    proto::Status close();
    // The server is gone: completes the file with what has arrived.
    proto::Status abandon();

    std::uint64_t frames() const;
    std::uint64_t gaps() const;
    double first_time() const;                // [s] of the state when the stream was opened
    std::optional<double> last_time() const;  // [s] of the last frame that arrived
    std::string summary() const;              // "301 frames, 0 gaps"

  private:
    struct Impl;
    explicit Recorder(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace headrace::client
