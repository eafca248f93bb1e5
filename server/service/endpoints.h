// Where the four sockets listen, worked out from one address; and the lock that keeps two servers off one ipc path.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "proto/result.h"

namespace headrace::server {

struct Endpoints {
    bool is_ipc{false};
    std::string control, events, frames, data;  // as ZeroMQ takes them; a tcp port of * means a free one
    std::filesystem::path ipc_path;             // of the control socket; empty on tcp
};

inline constexpr std::string_view kDefaultBind = "tcp://127.0.0.1:5755";

// `tcp://HOST:PORT` takes PORT and the next three, `tcp://HOST:*` four free ones; HOST is a loopback address.
// `ipc://PATH` takes PATH, PATH.events, PATH.frames and PATH.data. Errors: usage, with the remedy.
proto::Result<Endpoints> resolve_endpoints(std::string_view bind);

// The port of a tcp endpoint as bound.
std::optional<int> port_of(std::string_view endpoint);

// Holds PATH.lock for the life of the object. ZeroMQ takes over the path of a live server without a word, so the lock
// decides who may bind. Its end removes the socket files, which ZeroMQ leaves behind.
class IpcLock {
  public:
    // Errors: usage, when another server holds the lock or something else than a socket lies at one of the paths.
    static proto::Result<IpcLock> take(const Endpoints& endpoints);
    ~IpcLock();
    IpcLock(IpcLock&& other) noexcept;
    IpcLock& operator=(IpcLock&&) = delete;

  private:
    IpcLock(int fd, std::string path) : fd_(fd), path_(std::move(path)) {}
    int fd_;
    std::string path_;  // of the control socket
};

}  // namespace headrace::server
