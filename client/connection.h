// Requests and replies over the control socket of one server. Owner: one thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "client/rpc_socket.h"
#include "proto/messages.h"
#include "proto/messages_json.h"
#include "proto/result.h"

namespace headrace::client {

// How long a request may take. A query is answered from memory; anything else may wait for a step or a long load, so
// the server is asked now and then whether it is still there.
enum class Patience { query, while_alive };

class Connection {
  public:
    // Says what became of a server that we started ourselves; nothing while it lives.
    using PeerCheck = std::function<std::optional<std::string>()>;

    // Long enough for a server that is just starting: the socket keeps trying.
    static constexpr std::chrono::milliseconds kHelloPatience{3'000};

    // Connects and says hello. Errors: connection_failed, protocol_mismatch.
    static proto::Result<std::unique_ptr<Connection>> open(const std::string& endpoint, PeerCheck peer_check = {},
                                                           std::chrono::milliseconds patience = kHelloPatience);
    ~Connection();

    // Errors: what the server answers; connection_failed when it is gone; cancelled on Ctrl-C.
    proto::Result<proto::Json> request(std::string_view method, const proto::Json& params, Patience patience);

    const proto::HelloReply& hello() const { return hello_; }
    const std::string& endpoint() const { return endpoint_; }

    // Waits for the reply to request `id` on a socket of this server, with the same patience. Frames that arrive
    // meanwhile go to `on_frame`.
    using OnFrame = std::function<void(std::span<const std::byte>)>;
    proto::Result<proto::Json> await_reply(RpcSocket& socket, std::int64_t id, Patience patience,
                                           const OnFrame& on_frame = {});
    std::int64_t next_id() { return ++last_id_; }

  private:
    Connection(std::string endpoint, std::unique_ptr<RpcSocket> socket, PeerCheck peer_check);
    proto::Status say_hello(std::chrono::milliseconds patience);
    proto::Error lost(std::string_view what) const;
    std::optional<proto::Error> check_peer() const;

    std::string endpoint_;
    std::unique_ptr<RpcSocket> socket_;
    PeerCheck peer_check_;
    proto::HelloReply hello_;
    std::int64_t last_id_{0};
};

}  // namespace headrace::client
