// Live streams on the frames socket: lossy, at most so many frames per wall second, encoded only while somebody is
// subscribed to their topic.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>
#include <zmq.hpp>

#include "proto/messages.h"
#include "proto/result.h"
#include "server/publish/frame_hub.h"

namespace headrace::publish {

// Owner: the publisher thread.
class LiveStreams {
  public:
    static constexpr std::size_t kMost = 64;

    LiveStreams(FrameHub& hub, zmq::socket_t& socket, std::uint64_t session)
        : hub_(hub), socket_(socket), session_(session) {}

    proto::Result<proto::StreamOpenReply> open(const proto::StreamOpen& request);
    proto::Result<proto::StreamCloseReply> close(const std::string& stream);
    bool has(const std::string& stream) const { return streams_.contains(stream); }
    std::size_t size() const { return streams_.size(); }
    std::vector<proto::StreamState> states() const;

    bool drop(DemandId demand);               // ends the stream of this demand; false: not one of ours
    bool deliver(const CaptureFor& capture);  // false: not for one of ours
    void read_subscriptions();                // takes what XPUB reports

  private:
    struct Stream {
        proto::StreamOpen request;
        DemandId demand{};
        std::uint64_t seq{0};
        bool active{false};
    };
    bool is_subscribed(const std::string& topic) const;

    FrameHub& hub_;
    zmq::socket_t& socket_;
    std::uint64_t session_;
    std::map<std::string, Stream> streams_;  // by id, which is the topic
    std::set<std::string> subscriptions_;    // every subscribe is reported, only the last unsubscribe: a set
    std::uint64_t opened_{0};
};

}  // namespace headrace::publish
