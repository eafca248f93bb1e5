// A DEALER socket that carries JSON-RPC texts and frames. Owner: one thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "proto/result.h"

namespace headrace::client {

// What arrived; views that hold until the next receive().
struct Received {
    std::string_view json;             // a JSON-RPC text; empty when the message is a frame alone
    std::span<const std::byte> frame;  // a frame; empty when there is none
};

class RpcSocket {
  public:
    // Connecting is asynchronous: whether somebody answers shows at the first request. Error: usage for a text that is
    // no endpoint.
    static proto::Result<std::unique_ptr<RpcSocket>> connect(const std::string& endpoint);
    ~RpcSocket();

    void send(std::string_view text);
    std::optional<Received> receive(std::chrono::milliseconds timeout);  // nothing: timeout or a signal

  private:
    struct Impl;
    explicit RpcSocket(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace headrace::client
