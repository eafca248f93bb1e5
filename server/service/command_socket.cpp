#include "server/service/command_socket.h"

#include <algorithm>
#include <cerrno>
#include <utility>
#include <vector>
#include <zmq.hpp>

#include "server/service/limits.h"

namespace headrace::server {

namespace {

// A slow reader's replies wait here before they are dropped; more than a client has reason to send ahead.
constexpr int kHighWaterMark = 4'096;  // replies to one peer that does not read: as many as may be pending
constexpr int kHeartbeatInterval_ms = 5'000;
constexpr int kHeartbeatTimeout_ms = 60'000;   // large transfers on the same line trip shorter ones
constexpr std::uint64_t kControlIoThread = 1;  // bit 0; the publisher's sockets use the other I/O thread

// Where a reply goes: the peer, and whether it put the empty delimiter of a REQ socket before its request.
struct Route {
    std::string identity;
    bool has_delimiter{false};
};

std::vector<zmq::message_t> receive_parts(zmq::socket_t& socket) {
    std::vector<zmq::message_t> parts;
    zmq::message_t part;
    if (!socket.recv(part, zmq::recv_flags::dontwait)) return parts;
    bool more = part.more();
    parts.push_back(std::move(part));
    while (more) {
        zmq::message_t next;
        if (!socket.recv(next, zmq::recv_flags::dontwait)) break;  // a message arrives whole: does not happen
        more = next.more();
        parts.push_back(std::move(next));
    }
    return parts;
}

}  // namespace

struct CommandSocket::Impl {
    explicit Impl(zmq::context_t& context) : socket(context, zmq::socket_type::router) {}

    void send(const Route& route, const std::string& text) {
        const auto more = zmq::send_flags::sndmore | zmq::send_flags::dontwait;
        try {
            if (!socket.send(zmq::buffer(route.identity), more)) {  // EAGAIN: its queue is full
                ++dropped;
                return;
            }
            if (route.has_delimiter) socket.send(zmq::message_t(), more);
            socket.send(zmq::buffer(text), zmq::send_flags::dontwait);
        } catch (const zmq::error_t&) {  // EHOSTUNREACH: it has gone
            ++dropped;
        }
    }

    void dispatch(std::vector<zmq::message_t>& parts, const OnRequest& on_request, const OnBadParts& on_bad_parts) {
        Route route{parts[0].to_string(), parts.size() > 1 && parts[1].size() == 0};
        const std::size_t front = route.has_delimiter && parts.size() > 2 ? 2 : 1;
        // A DEALER's single empty part is an empty request, not a delimiter without one.
        if (parts.size() == 2) route.has_delimiter = false;
        ReplySink sink = [this, route](const std::string& text) { send(route, text); };
        if (parts.size() == front + 1)
            on_request(parts[front].to_string_view(), std::move(sink));
        else
            on_bad_parts(parts.size() - front, std::move(sink));
    }

    zmq::socket_t socket;
    std::string endpoint;
    std::uint64_t dropped{0};
};

CommandSocket::CommandSocket(zmq::context_t& context, const std::string& endpoint)
    : impl_(std::make_unique<Impl>(context)) {
    zmq::socket_t& socket = impl_->socket;
    socket.set(zmq::sockopt::affinity, kControlIoThread);
    socket.set(zmq::sockopt::router_mandatory, true);
    socket.set(zmq::sockopt::router_handover, false);
    socket.set(zmq::sockopt::linger, 0);
    socket.set(zmq::sockopt::sndtimeo, 0);
    socket.set(zmq::sockopt::sndhwm, kHighWaterMark);
    socket.set(zmq::sockopt::maxmsgsize, kHardMessageLimit);
    socket.set(zmq::sockopt::heartbeat_ivl, kHeartbeatInterval_ms);
    socket.set(zmq::sockopt::heartbeat_timeout, kHeartbeatTimeout_ms);
    socket.set(zmq::sockopt::ipv6, endpoint.find('[') != std::string::npos);
    socket.bind(endpoint);
    impl_->endpoint = socket.get(zmq::sockopt::last_endpoint);
}

CommandSocket::~CommandSocket() = default;

const std::string& CommandSocket::endpoint() const {
    return impl_->endpoint;
}

void CommandSocket::wait(std::span<const int> descriptors, std::optional<Clock::time_point> deadline) {
    std::vector<zmq::pollitem_t> items{{impl_->socket.handle(), 0, ZMQ_POLLIN, 0}};
    for (int descriptor : descriptors) items.push_back({nullptr, descriptor, ZMQ_POLLIN, 0});
    std::chrono::milliseconds timeout(-1);
    if (deadline) timeout = std::max(std::chrono::ceil<std::chrono::milliseconds>(*deadline - Clock::now()), {});
    try {
        zmq::poll(items, timeout);
    } catch (const zmq::error_t& error) {
        if (error.num() != EINTR) throw;
    }
}

std::size_t CommandSocket::receive(std::size_t limit, const OnRequest& on_request, const OnBadParts& on_bad_parts) {
    std::size_t count = 0;
    for (; count < limit; ++count) {
        std::vector<zmq::message_t> parts = receive_parts(impl_->socket);
        if (parts.empty()) break;
        if (parts.size() > 1) impl_->dispatch(parts, on_request, on_bad_parts);
    }
    return count;
}

std::uint64_t CommandSocket::dropped_replies() const {
    return impl_->dropped;
}

void CommandSocket::set_linger(std::chrono::milliseconds linger) {
    impl_->socket.set(zmq::sockopt::linger, static_cast<int>(linger.count()));
}

}  // namespace headrace::server
