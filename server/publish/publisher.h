// The publisher thread: events, frames and data sockets, encoding, streams and recordings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "proto/messages.h"
#include "server/event_log.h"
#include "server/outbox.h"
#include "server/probe_board.h"
#include "server/publish/frame_hub.h"
#include "server/status.h"

namespace zmq {
class context_t;
}

namespace headrace::publish {

struct PublisherOptions {
    std::string events_endpoint, frames_endpoint, data_endpoint;  // to bind; a tcp port of * takes a free one
    std::filesystem::path data_folder;                            // recordings go below it
    std::uint64_t session{};
    std::int64_t soft_message_limit{16 << 20};  // [bytes]
    std::int64_t hard_message_limit{64 << 20};  // [bytes]
};

// What the service thread hands over.
using PublisherRequest =
    std::variant<proto::StreamOpen, proto::StreamAck, proto::StreamClose, proto::RecordStart, proto::RecordStop>;

struct PublisherCounts {
    std::size_t recordings{0};
    std::vector<proto::StreamState> readers;  // one per stream
};

// Puts them into a status, which another thread has written.
void tell_counts(PublisherCounts counts, proto::SimStatusReply& status);

class Publisher {
  public:
    // Binds the three sockets; throws std::runtime_error naming the endpoint when one cannot be bound.
    Publisher(zmq::context_t& context, const PublisherOptions& options, FrameHub& hub, server::EventLog& events,
              const server::StatusBoard& board, server::ProbeBoard& probes, server::Outbox& outbox);
    ~Publisher();  // stop()

    // The endpoints as bound, with the ports that were taken.
    const std::string& events_endpoint() const;
    const std::string& frames_endpoint() const;
    const std::string& data_endpoint() const;

    PublisherCounts counts() const;  // any thread

    void start();
    void stop();  // finishes recordings, flushes events, joins; idempotent

    // Any thread. Exactly one outcome in the outbox under the token.
    void post(server::Token token, PublisherRequest request);
    // Any thread: a command that was applied; goes into running recordings. One line of JSON.
    void log_command(std::string json, double time);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace headrace::publish
