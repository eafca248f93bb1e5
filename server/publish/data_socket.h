// The data socket: JSON-RPC requests of those who want frames without loss. Single frames and lossless streams.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <zmq.hpp>

#include "proto/messages.h"
#include "proto/result.h"
#include "server/publish/frame_hub.h"
#include "server/publish/lossless_streams.h"
#include "server/status.h"

namespace headrace::proto {
struct RpcRequest;
}

namespace headrace::publish {

// Owner: the publisher thread.
class DataSocket {
  public:
    // `settle` delivers what the simulation has handed over so far: a close or an acknowledgement comes after it.
    // `told` is called before a reply: who reads the status after it sees the change.
    DataSocket(FrameHub& hub, zmq::socket_t& socket, LosslessStreams& streams, const server::StatusBoard& board,
               std::uint64_t session, std::size_t soft_limit, std::function<void()> settle, std::function<void()> told)
        : hub_(hub),
          socket_(socket),
          streams_(streams),
          board_(board),
          session_(session),
          soft_limit_(soft_limit),
          settle_(std::move(settle)),
          told_(std::move(told)) {}

    void read_requests();                                     // handles what has arrived
    bool deliver(const CaptureFor& capture);                  // false: not a frame.get of ours
    void refuse(DemandId demand, const proto::Error& error);  // nothing happens when it is not ours
    void refuse_waiting(const proto::Error& error);

  private:
    struct WaitingFrame {
        proto::FrameGet request;
        Peer peer;
        std::string id;  // of the request, JSON text
    };
    void handle(const Peer& peer, std::string_view text);
    void carry_out(const Peer& peer, const proto::RpcRequest& request);
    void answer(const Peer& peer, const std::string& text);
    bool send_head(const Peer& peer);

    FrameHub& hub_;
    zmq::socket_t& socket_;
    LosslessStreams& streams_;
    const server::StatusBoard& board_;
    std::uint64_t session_;
    std::size_t soft_limit_;
    std::function<void()> settle_, told_;
    std::map<DemandId, WaitingFrame> waiting_;
};

}  // namespace headrace::publish
