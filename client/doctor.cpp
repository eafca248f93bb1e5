#include "client/doctor.h"

#include <arpa/inet.h>
#include <cairo.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>
#include <zlib.h>
#include <zmq.h>
#include <zstd.h>

#include <CLI/Version.hpp>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "client/arguments.h"
#include "client/connection.h"
#include "client/doctor_programs.h"
#include "client/endpoints.h"
#include "client/spawn.h"
#include "client/text.h"
#include "proto/version.h"

namespace headrace::client {

namespace fs = std::filesystem;
using proto::ErrorCode;

namespace {

using namespace std::chrono_literals;

constexpr rlim_t kEnoughFiles = 1'024;             // sockets of many subscribers, recordings, libraries
constexpr std::uintmax_t kEnoughSpace = 1u << 30;  // [bytes] 10^4 frames of 3,000 particles
constexpr int kPorts = 4;                          // control, events, frames, data

Finding failure(std::string subject, std::string found, std::string remedy, ErrorCode code) {
    return {std::move(subject), Health::failure, std::move(found), std::move(remedy), code};
}

Finding versions() {
    int major = 0, minor = 0, patch = 0;
    zmq_version(&major, &minor, &patch);
    const auto dotted = [](int a, int b, int c) {
        return std::to_string(a) + "." + std::to_string(b) + "." + std::to_string(c);
    };
    return good("client",
                std::string("headrace ") + proto::kProgramVersion + ", protocol " +
                    std::to_string(proto::kProtocolVersion) + "; ZeroMQ " + dotted(major, minor, patch) +
                    ", nlohmann/json " +
                    dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH) +
                    ", CLI11 " CLI11_VERSION ", zlib " + zlibVersion() + ", zstd " + ZSTD_versionString() + ", cairo " +
                    cairo_version_string());
}

// What the server's solver can make use of; it is built for several sets and takes the best one when it starts.
Finding instruction_sets() {
#if defined(__x86_64__) && defined(__GNUC__)
    std::string names;
    const auto add = [&](bool has, const char* name) {
        if (has) names += (names.empty() ? "" : ", ") + std::string(name);
    };
    add(__builtin_cpu_supports("sse4.2"), "SSE4");
    add(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"), "AVX2");
    add(__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"),
        "AVX-512");
    if (names.find("AVX") == std::string::npos)
        return warning("instruction sets", names.empty() ? "none beyond the baseline" : names,
                       "simulations run, several times slower than with AVX2; in a virtual machine pass the host's "
                       "processor through");
    return good("instruction sets", names);
#else
    return good("instruction sets", "those of this processor's baseline");
#endif
}

Finding threads() {
    cpu_set_t set;
    CPU_ZERO(&set);
    const int usable = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
    const auto present = static_cast<int>(std::thread::hardware_concurrency());
    std::string found = plural(usable, "processor") + " to run on";
    const char* wanted = std::getenv("OMP_NUM_THREADS");
    if (wanted != nullptr) found += ", OMP_NUM_THREADS=" + std::string(wanted);
    if (wanted != nullptr && parse_number(wanted).value_or(0) > usable)
        return warning("threads", found, "more threads than processors wait for each other: unset OMP_NUM_THREADS");
    if (usable < present)
        return warning("threads", found + " of " + std::to_string(present),
                       "this process is bound to some (taskset, a container)");
    return good("threads", found);
}

Finding open_files() {
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    const std::string found =
        limit.rlim_cur == RLIM_INFINITY ? "as many as wanted" : "at most " + std::to_string(limit.rlim_cur);
    if (limit.rlim_cur < kEnoughFiles)
        return warning("open files", found, "many subscribers need more: ulimit -n " + std::to_string(kEnoughFiles));
    return good("open files", found);
}

Finding file_size() {
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    if (limit.rlim_cur == RLIM_INFINITY) return good("size of files", "not limited");
    return warning("size of files", "at most " + std::to_string(limit.rlim_cur) + " bytes",
                   "recordings end there: ulimit -f unlimited");
}

// Can something be written into the folder? A file is made and removed.
Finding folder(const std::string& subject, const fs::path& path, const std::string& remedy) {
    std::string name = (path / ".headrace-doctor-XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) return failure(subject, path.string() + ": " + std::strerror(errno), remedy, ErrorCode::file_error);
    close(file);
    unlink(name.c_str());
    std::error_code error;
    const std::uintmax_t space = fs::space(path, error).available;
    const double gib = static_cast<double>(space >> 20) / 1'024.0;
    const std::string free = gib < 10.0 ? number(std::round(10.0 * gib) / 10.0) : with_thousands(std::llround(gib));
    const std::string found = path.string() + ", " + free + " GiB free";
    if (!error && space < kEnoughSpace)
        return warning(subject, found, "recordings will not fit for long: free some space");
    return good(subject, found);
}

// A server of our own: found, started, spoken to, ended.
Finding private_server() {
    constexpr const char* kSubject = "private server";
    const auto binary = find_server_binary();
    const bool is_chosen = std::getenv("HEADRACE_SERVER_BINARY") != nullptr;
    if (!binary)
        return failure(kSubject, is_chosen ? "HEADRACE_SERVER_BINARY is no program" : "no headraced is found",
                       "install headraced beside headrace or on the PATH, or set HEADRACE_SERVER_BINARY to it",
                       ErrorCode::connection_failed);
    auto server = PrivateServer::start(1);
    if (!server)
        return failure(kSubject, binary->string() + ": " + server.error().message, server.error().hint,
                       server.error().code);
    auto connection = Connection::open((*server)->endpoint(), [&] { return (*server)->fate(); });
    if (!connection)
        return failure(kSubject, binary->string() + ": " + connection.error().message,
                       "use a headrace and a headraced of one version", connection.error().code);
    const std::string found = binary->string() + ", headraced " + (*connection)->hello().version;
    if ((*connection)->hello().version != proto::kProgramVersion)
        return warning(kSubject, found, "use a headrace and a headraced of one version");
    return good(kSubject, found);
}

// Whether the four ports can be had: a server would take them.
std::optional<int> first_taken_port(int first) {
    for (int port = first; port < first + kPorts; ++port) {
        const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const int yes = 1;
        setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        const bool is_free = ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
        close(socket);
        if (!is_free) return port;
    }
    return std::nullopt;
}

std::optional<int> loopback_port(const std::string& endpoint) {
    constexpr std::string_view kLoopback = "tcp://127.0.0.1:";
    if (!endpoint.starts_with(kLoopback)) return std::nullopt;
    const auto port = parse_number(endpoint.substr(kLoopback.size()));
    return port && *port > 0 && *port + kPorts <= 65'536 ? std::optional(static_cast<int>(*port)) : std::nullopt;
}

// The server that commands would go to. None is no failure where none was asked for.
Finding running_server(const std::string& server) {
    constexpr const char* kSubject = "server";
    const std::string endpoint = control_endpoint(server);
    auto connection = Connection::open(endpoint, {}, 1s);
    if (connection) {
        const proto::HelloReply& hello = (*connection)->hello();
        const std::string found = endpoint + ", headraced " + hello.version + ", " + plural(hello.threads, "thread");
        if (hello.version != proto::kProgramVersion)
            return warning(kSubject, found, "use a headrace and a headraced of one version");
        return good(kSubject, found);
    }
    const proto::Error& error = connection.error();
    if (error.code == ErrorCode::connection_failed && error.path.empty()) {
        const auto port = loopback_port(endpoint);
        if (const auto taken = port ? first_taken_port(*port) : std::nullopt)
            return failure(kSubject,
                           "port " + std::to_string(*taken) + " is taken, and no headraced answers at " + endpoint,
                           "end that program, or choose other ports: headraced --bind 'tcp://127.0.0.1:*'", error.code);
        if (!is_server_chosen(server))
            return good(kSubject, "none at " + endpoint + ", whose ports are free: headraced & starts one");
    }
    return failure(kSubject, error.message, error.hint.empty() ? "headraced --bind starts one there" : error.hint,
                   error.code);
}

}  // namespace

std::vector<Finding> examine(const std::string& server) {
    std::error_code error;
    const fs::path here = fs::current_path(error), temporary = fs::temp_directory_path(error);
    return {
        versions(),
        instruction_sets(),
        threads(),
        open_files(),
        file_size(),
        folder("this folder", here, "recordings and pictures go here unless told otherwise: choose a folder of yours"),
        folder("temporary folder", error ? fs::path("/tmp") : temporary, "set TMPDIR to a folder that can be written"),
        film_maker(),
        python_modules(),
        private_server(),
        running_server(server)};
}

}  // namespace headrace::client
