// The control socket: ROUTER frames <-> request texts. Knows routes and delimiters, nothing about JSON-RPC.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "server/service/responder.h"

namespace zmq {
class context_t;
}

namespace headrace::server {

// Owner: the service thread (made by another before that one starts).
class CommandSocket {
  public:
    using Clock = std::chrono::steady_clock;
    // A request's text and where its reply goes; the sink is valid as long as the socket.
    using OnRequest = std::function<void(std::string_view text, ReplySink sink)>;
    // A message with a number of parts that no request has.
    using OnBadParts = std::function<void(std::size_t parts, ReplySink sink)>;

    // Binds. Throws zmq::error_t when the endpoint cannot be had.
    CommandSocket(zmq::context_t& context, const std::string& endpoint);
    ~CommandSocket();

    const std::string& endpoint() const;  // as bound, with the port that was taken

    // Sleeps until a message has come, one of the descriptors is readable, or the deadline has passed.
    void wait(std::span<const int> descriptors, std::optional<Clock::time_point> deadline);

    // Hands over what has come, at most `limit` messages, so that other work gets its turn. Returns how many.
    std::size_t receive(std::size_t limit, const OnRequest& on_request, const OnBadParts& on_bad_parts);

    // Replies that could not be sent: their peer has gone, or does not read.
    std::uint64_t dropped_replies() const;

    // How long the last replies may take to leave after the socket is destroyed.
    void set_linger(std::chrono::milliseconds linger);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace headrace::server
