#include "client/rpc_socket.h"

#include <cstring>
#include <vector>
#include <zmq.hpp>

#include "proto/frame.h"

namespace headrace::client {

struct RpcSocket::Impl {
    zmq::context_t context{1};
    zmq::socket_t socket{context, zmq::socket_type::dealer};
    std::vector<zmq::message_t> parts;  // of the last message; receive() hands out views into them
};

namespace {

constexpr int kHeartbeat = 5'000;          // [ms]
constexpr int kHeartbeatTimeout = 60'000;  // [ms] large frames on a slow line trip shorter ones

bool is_frame(const zmq::message_t& part) {
    return part.size() >= sizeof(proto::FrameHeader) &&
           std::memcmp(part.data<char>() + proto::kTopicBytes, proto::kFrameMagic, 8) == 0;
}

}  // namespace

RpcSocket::RpcSocket(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RpcSocket::~RpcSocket() = default;

proto::Result<std::unique_ptr<RpcSocket>> RpcSocket::connect(const std::string& endpoint) {
    auto impl = std::make_unique<Impl>();
    impl->socket.set(zmq::sockopt::linger, 0);
    impl->socket.set(zmq::sockopt::heartbeat_ivl, kHeartbeat);
    impl->socket.set(zmq::sockopt::heartbeat_timeout, kHeartbeatTimeout);
    impl->socket.set(zmq::sockopt::ipv6, 1);
    try {
        impl->socket.connect(endpoint);
    } catch (const zmq::error_t& error) {
        return proto::Error{proto::ErrorCode::usage, std::string("not an endpoint: ") + error.what(), endpoint,
                            "write tcp://HOST:PORT or ipc://PATH"};
    }
    return std::unique_ptr<RpcSocket>(new RpcSocket(std::move(impl)));
}

void RpcSocket::send(std::string_view text) {
    // A DEALER without a peer would block once its queue is full; requests are few, so a full queue means nobody reads.
    // What is not sent is not answered, and the caller's patience ends as for a lost request.
    (void)impl_->socket.send(zmq::buffer(text), zmq::send_flags::dontwait);
}

std::optional<Received> RpcSocket::receive(std::chrono::milliseconds timeout) {
    zmq::pollitem_t item{impl_->socket.handle(), 0, ZMQ_POLLIN, 0};
    try {
        if (zmq::poll(&item, 1, timeout) == 0) return std::nullopt;
    } catch (const zmq::error_t& error) {
        if (error.num() == EINTR) return std::nullopt;
        throw;
    }
    impl_->parts.clear();
    do {
        if (!impl_->socket.recv(impl_->parts.emplace_back(), zmq::recv_flags::dontwait)) return std::nullopt;
    } while (impl_->parts.back().more());

    Received received;
    for (const zmq::message_t& part : impl_->parts) {
        if (is_frame(part))
            received.frame = {part.data<std::byte>(), part.size()};
        else if (part.size() > 0)
            received.json = part.to_string_view();
    }
    return received;
}

}  // namespace headrace::client
