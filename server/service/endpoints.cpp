#include "server/service/endpoints.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;
using proto::Result;
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kTcp = "tcp://";
constexpr std::string_view kIpc = "ipc://";
constexpr std::size_t kMaxIpcPath = sizeof(sockaddr_un::sun_path) - 1;  // 107 characters on Linux
constexpr int kLastPort = 65535;
constexpr std::array<const char*, 4> kSocketEndings{"", ".events", ".frames", ".data"};
constexpr const char* kLockEnding = ".lock";

Error usage(std::string message, std::string hint) {
    return {ErrorCode::usage, std::move(message), "", std::move(hint)};
}

std::string quoted(std::string_view text) {
    std::string out;
    return out.append("\"").append(text).append("\"");
}

// The numeric form of a loopback host: localhost, 127.0.0.0/8 or [::1]. Nothing for any other.
std::optional<std::string> loopback_host(const std::string& host) {
    if (host == "localhost") return "127.0.0.1";
    if (host == "[::1]") return host;
    in_addr address{};
    if (::inet_pton(AF_INET, host.c_str(), &address) != 1) return std::nullopt;
    if ((ntohl(address.s_addr) >> 24) != 127) return std::nullopt;
    return host;
}

std::optional<int> parse_port(std::string_view text) {
    int port = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return port;
}

Result<Endpoints> resolve_tcp(std::string_view bind) {
    const std::string_view address = bind.substr(kTcp.size());
    const std::size_t colon = address.rfind(':');
    if (colon == std::string_view::npos)
        return usage(quoted(bind) + " has no port", "for example " + std::string(kDefaultBind));
    const auto host = loopback_host(std::string(address.substr(0, colon)));
    const std::string_view port_text = address.substr(colon + 1);
    if (!host)
        return usage(
            quoted(bind) + " is not a loopback address: whoever reaches the port commands the server",
            "listen on 127.0.0.1 and reach it from afar with ssh -L 5755:127.0.0.1:5755 -L 5756:127.0.0.1:5756 "
            "-L 5757:127.0.0.1:5757 -L 5758:127.0.0.1:5758 HOST");
    const std::string front = std::string(kTcp) + *host + ":";
    Endpoints endpoints;
    if (port_text == "*") {
        endpoints.control = endpoints.events = endpoints.frames = endpoints.data = front + "*";
        return endpoints;
    }
    const auto port = parse_port(port_text);
    if (!port || *port < 1 || *port > kLastPort - 3)
        return usage(quoted(port_text) + " is not a port: 1 to 65532, or * for a free one",
                     "the server takes this port and the next three");
    endpoints.control = front + std::to_string(*port);
    endpoints.events = front + std::to_string(*port + 1);
    endpoints.frames = front + std::to_string(*port + 2);
    endpoints.data = front + std::to_string(*port + 3);
    return endpoints;
}

Result<Endpoints> resolve_ipc(std::string_view bind) {
    const std::string_view given = bind.substr(kIpc.size());
    if (given.empty() || given == "*" || given.front() == '@' || given.find('\0') != std::string_view::npos)
        return usage(quoted(bind) + " needs the path of a file", "for example ipc:///run/user/1000/headrace.sock");
    const std::string path = fs::absolute(fs::path(given)).lexically_normal().string();
    const std::string longest = path + ".events";
    if (longest.size() > kMaxIpcPath)
        return usage("the ipc path is too long: " + longest + " has " + std::to_string(longest.size()) +
                         " characters, the system takes " + std::to_string(kMaxIpcPath),
                     "use a shorter folder");
    Endpoints endpoints;
    endpoints.is_ipc = true;
    endpoints.ipc_path = path;
    endpoints.control = std::string(kIpc) + path;
    endpoints.events = endpoints.control + ".events";
    endpoints.frames = endpoints.control + ".frames";
    endpoints.data = endpoints.control + ".data";
    return endpoints;
}

// ZeroMQ removes what lies at the path before it binds: never something that is not a socket.
std::optional<Error> refuse_foreign_file(const std::string& path) {
    struct stat info {};
    if (::lstat(path.c_str(), &info) != 0 || S_ISSOCK(info.st_mode)) return std::nullopt;
    return usage(path + " exists and is not a socket", "choose another ipc path");
}

}  // namespace

Result<Endpoints> resolve_endpoints(std::string_view bind) {
    if (bind.starts_with(kTcp)) return resolve_tcp(bind);
    if (bind.starts_with(kIpc)) return resolve_ipc(bind);
    return usage(quoted(bind) + " is neither tcp:// nor ipc://", "for example " + std::string(kDefaultBind));
}

std::optional<int> port_of(std::string_view endpoint) {
    const std::size_t colon = endpoint.rfind(':');
    if (!endpoint.starts_with(kTcp) || colon == std::string_view::npos) return std::nullopt;
    return parse_port(endpoint.substr(colon + 1));
}

Result<IpcLock> IpcLock::take(const Endpoints& endpoints) {
    for (const char* ending : kSocketEndings)
        if (auto error = refuse_foreign_file(endpoints.ipc_path.string() + ending)) return *std::move(error);

    const fs::path path = endpoints.ipc_path.string() + kLockEnding;
    // The holder before us removes the file when it ends: a lock on a removed file is none, so look again.
    while (true) {
        const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
        if (fd < 0)
            return usage("cannot make " + path.string() + ": " + std::strerror(errno),
                         "the folder must exist and be writable");
        if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
            ::close(fd);
            return usage("another server listens on " + endpoints.control,
                         "choose another path, or end that server (headrace shutdown)");
        }
        struct stat held {
        }, present{};
        if (::fstat(fd, &held) == 0 && ::lstat(path.c_str(), &present) == 0 && held.st_ino == present.st_ino)
            return IpcLock(fd, endpoints.ipc_path.string());
        ::close(fd);
    }
}

IpcLock::IpcLock(IpcLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)), path_(std::move(other.path_)) {}

IpcLock::~IpcLock() {
    if (fd_ < 0) return;
    for (const char* ending : kSocketEndings) ::unlink((path_ + ending).c_str());
    ::unlink((path_ + kLockEnding).c_str());
    ::close(fd_);
}

}  // namespace headrace::server
