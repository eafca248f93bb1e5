#include "client/connection.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "client/interrupt.h"
#include "proto/envelope.h"
#include "proto/version.h"

namespace headrace::client {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kQueryPatience = 5s;
constexpr auto kSilence = 2s;        // of a request under way, after which the server is asked for a sign of life
constexpr auto kProbePatience = 3s;  // for that sign
constexpr auto kSlice = 100ms;       // between looks at Ctrl-C and at a private server

}  // namespace

Connection::Connection(std::string endpoint, std::unique_ptr<RpcSocket> socket, PeerCheck peer_check)
    : endpoint_(std::move(endpoint)), socket_(std::move(socket)), peer_check_(std::move(peer_check)) {}

Connection::~Connection() = default;

proto::Result<std::unique_ptr<Connection>> Connection::open(const std::string& endpoint, PeerCheck peer_check,
                                                            std::chrono::milliseconds patience) {
    auto socket = RpcSocket::connect(endpoint);
    if (!socket) return socket.error();
    std::unique_ptr<Connection> connection(new Connection(endpoint, *std::move(socket), std::move(peer_check)));
    if (auto greeted = connection->say_hello(patience); !greeted) return greeted.error();
    return connection;
}

proto::Error Connection::lost(std::string_view what) const {
    return {proto::ErrorCode::connection_failed, std::string(what) + " from " + endpoint_, "",
            peer_check_ ? "" : "start one: headraced &"};
}

std::optional<proto::Error> Connection::check_peer() const {
    if (!peer_check_) return std::nullopt;
    if (const auto fate = peer_check_())
        return proto::Error{proto::ErrorCode::connection_failed, "the private server " + *fate, "", ""};
    return std::nullopt;
}

proto::Status Connection::say_hello(std::chrono::milliseconds patience) {
    const std::int64_t id = next_id();
    socket_->send(proto::rpc_request_text(id, "hello", proto::Json::object()));
    const auto deadline = Clock::now() + patience;
    while (Clock::now() < deadline && !is_interrupted()) {
        if (auto gone = check_peer()) return *gone;
        const auto received = socket_->receive(std::min<std::chrono::milliseconds>(kSlice, patience));
        if (!received || received->json.empty()) continue;
        auto reply = proto::parse_rpc_reply(received->json);
        if (!reply || reply->id != id)
            return proto::Error{proto::ErrorCode::connection_failed, "something else than headraced answers", endpoint_,
                                "give the control endpoint, by default tcp://127.0.0.1:5755"};
        if (!reply->result) return reply->result.error();
        // The number comes first: the rest of the reply may look otherwise in another protocol.
        const proto::Json& hello = *reply->result;
        const int protocol = hello.is_object() ? hello.value("protocol", 0) : 0;
        if (protocol != proto::kProtocolVersion)
            return proto::Error{proto::ErrorCode::protocol_mismatch,
                                "the server speaks protocol " + std::to_string(protocol) + ", this client " +
                                    std::to_string(proto::kProtocolVersion),
                                endpoint_, "use a headrace and a headraced of one version"};
        auto decoded = proto::from_json<proto::HelloReply>(hello, "result");
        if (!decoded) return decoded.error();
        hello_ = *std::move(decoded);
        return proto::Done{};
    }
    return lost("no answer");
}

proto::Result<proto::Json> Connection::request(std::string_view method, const proto::Json& params, Patience patience) {
    const std::int64_t id = next_id();
    socket_->send(proto::rpc_request_text(id, method, params));
    return await_reply(*socket_, id, patience);
}

proto::Result<proto::Json> Connection::await_reply(RpcSocket& socket, std::int64_t id, Patience patience,
                                                   const OnFrame& on_frame) {
    const bool was_interrupted = is_interrupted();  // then this request is part of ending well
    const auto sent = Clock::now();
    auto last_sign = sent;
    std::int64_t probe = 0;  // id of a hello under way; 0: none
    auto probe_sent = sent;
    for (;;) {
        if (const auto received = socket.receive(kSlice)) {
            last_sign = Clock::now();
            if (!received->frame.empty() && on_frame) on_frame(received->frame);
            if (!received->json.empty()) {
                auto reply = proto::parse_rpc_reply(received->json);
                if (!reply) return reply.error();
                if (reply->id == id) return std::move(reply->result);
                if (reply->id == probe) probe = 0;
            }
            continue;
        }
        if (auto gone = check_peer()) return *gone;
        if (is_interrupted() && !was_interrupted)
            return proto::Error{proto::ErrorCode::cancelled, "interrupted", "", ""};
        const auto now = Clock::now();
        if (patience == Patience::query && now - sent > kQueryPatience) return lost("no answer");
        if (probe == 0 && now - last_sign > kSilence) {
            probe = next_id();
            probe_sent = now;
            socket.send(proto::rpc_request_text(probe, "hello", proto::Json::object()));
        }
        if (probe != 0 && now - probe_sent > kProbePatience) return lost("no sign of life");
    }
}

}  // namespace headrace::client
