// Lossless streams on the data socket: a window of frames that were sent and not yet acknowledged. The frames in the
// window are kept, so that a reader that lost its connection resumes without a gap.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <string>
#include <vector>
#include <zmq.hpp>

#include "proto/messages.h"
#include "proto/result.h"
#include "server/event_log.h"
#include "server/publish/frame_hub.h"
#include "server/status.h"

namespace headrace::publish {

// Who sent a request: the ROUTER's identity, and whether it put an empty delimiter before its text (REQ does).
struct Peer {
    std::string identity;
    bool has_delimiter{false};
};

// Owner: the publisher thread.
class LosslessStreams {
  public:
    static constexpr std::size_t kMost = 16;
    static constexpr std::size_t kMostWindowBytes = std::size_t{512} << 20;  // per stream

    LosslessStreams(FrameHub& hub, zmq::socket_t& socket, std::uint64_t session, server::EventLog& events,
                    const server::StatusBoard& board)
        : hub_(hub), socket_(socket), session_(session), events_(events), board_(board) {}

    // Opens, or takes over (request.resume). Frames are sent after `flush`, so that the reply comes first.
    proto::Result<proto::StreamOpenReply> open(const proto::StreamOpen& request, const Peer& peer);
    void flush(const std::string& stream);
    proto::Result<proto::StreamAckReply> ack(const proto::StreamAck& request);
    // No more captures; the frames in the window stay until they are acknowledged or the peer is gone.
    proto::Result<proto::StreamCloseReply> close(const std::string& stream);
    bool has(const std::string& stream) const { return streams_.contains(stream); }
    std::size_t size() const { return streams_.size(); }
    std::vector<proto::StreamState> states() const;

    bool deliver(const CaptureFor& capture);             // false: not for one of ours
    bool fail(DemandId demand, const std::string& why);  // false: not one of ours
    // Reports and fails what has held the simulation up for too long. Returns when to look again.
    std::chrono::steady_clock::time_point check_stalls();

  private:
    using Clock = std::chrono::steady_clock;
    struct Sent {
        std::uint64_t seq{};
        zmq::message_t message;
    };
    struct Stream {
        proto::StreamOpen request;
        Peer peer;
        DemandId demand{};
        std::uint64_t seq{0};    // last captured
        std::uint64_t acked{0};  // cumulative
        std::uint64_t sent{0};   // last handed to the socket for this peer
        std::int64_t window{};   // granted
        std::deque<Sent> unacked;
        bool is_closing{false};
        bool stall_reported{false};
        Clock::time_point closed_at{};  // or of the last acknowledgement since
        Clock::time_point retry_at{};
    };
    proto::Result<proto::StreamOpenReply> resume(const proto::StreamOpen& request, const Peer& peer);
    void send_unsent(Stream& stream);
    void drop_acked(Stream& stream);
    void fail(std::map<std::string, Stream>::iterator place, const std::string& why);
    void report(const std::string& type, const std::string& stream, const std::string& message) const;

    FrameHub& hub_;
    zmq::socket_t& socket_;
    std::uint64_t session_;
    server::EventLog& events_;
    const server::StatusBoard& board_;
    std::map<std::string, Stream> streams_;
    std::uint64_t opened_{0};
};

}  // namespace headrace::publish
