#include "client/spawn.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <vector>

#include "client/interrupt.h"

namespace headrace::client {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

namespace {

constexpr auto kReadyPatience = 20s;  // a loaded machine may take long to start a process
constexpr auto kEndPatience = 10s;    // after end-of-file; it closes recordings first
constexpr auto kTermPatience = 2s;
constexpr std::size_t kLongestIpcPath = 100;  // [bytes] 107 less the server's endings for its other sockets

bool is_program(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

proto::Error failed(const std::string& what, const std::string& hint = {}) {
    return {proto::ErrorCode::connection_failed, what, "", hint};
}

// A private folder short enough for an ipc path.
proto::Result<fs::path> make_private_folder() {
    std::error_code error;
    fs::path base = fs::temp_directory_path(error);
    if (error || base.native().size() + 24 > kLongestIpcPath) base = "/tmp";
    std::string pattern = (base / "headrace-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        return proto::Error{proto::ErrorCode::file_error, std::strerror(errno), base.string(),
                            "set TMPDIR to a folder that can be written"};
    return fs::path(pattern);
}

// Both ends stay with this process only; posix_spawn's dup2 hands one on.
bool make_pipe(int (&ends)[2]) {
    return pipe2(ends, O_CLOEXEC) == 0;
}

}  // namespace

std::optional<fs::path> find_server_binary() {
    if (const char* chosen = std::getenv("HEADRACE_SERVER_BINARY"); chosen != nullptr && *chosen != '\0')
        return is_program(chosen) ? std::optional<fs::path>(chosen) : std::nullopt;
    std::error_code error;
    const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
    if (!error) {
        if (is_program(here / "headraced")) return here / "headraced";
        const fs::path built = here.parent_path() / "server" / "headraced";
        if (is_program(built)) return built;
    }
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (is_program(fs::path(folder) / "headraced")) return fs::path(folder) / "headraced";
    return std::nullopt;
}

std::optional<std::string> endpoint_in_ready_line(const std::string& line) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object()) return std::nullopt;
    const auto control = json.find("control");
    if (control == json.end() || !control->is_string()) return std::nullopt;
    return control->get<std::string>();
}

proto::Result<std::unique_ptr<PrivateServer>> PrivateServer::start(int threads, const fs::path& data_folder) {
    const auto binary = find_server_binary();
    if (!binary) return failed("headraced is not installed beside headrace", "set HEADRACE_SERVER_BINARY to its path");
    auto folder = make_private_folder();
    if (!folder) return folder.error();
    std::unique_ptr<PrivateServer> server(new PrivateServer);
    server->folder_ = *folder;
    if (auto spawned = server->spawn(*binary, threads, data_folder); !spawned) return spawned.error();
    if (auto ready = server->wait_until_ready(); !ready) return ready.error();
    return server;
}

proto::Status PrivateServer::spawn(const fs::path& binary, int threads, const fs::path& data_folder) {
    int in[2], out[2];
    if (!make_pipe(in)) return failed(std::strerror(errno));
    if (!make_pipe(out)) {
        close(in[0]), close(in[1]);
        return failed(std::strerror(errno));
    }
    const std::string log = folder_ / "log";
    std::vector<std::string> words{binary.string(),
                                   "--bind",
                                   "ipc://" + (folder_ / "s").string(),
                                   "--data",
                                   (data_folder.empty() ? folder_ : data_folder).string(),
                                   "--json",
                                   "--quit-on-stdin-eof"};
    if (threads > 0) words.insert(words.end(), {"--threads", std::to_string(threads)});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    // A process group of its own: Ctrl-C reaches the client only, which then ends the run in order.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    const int error = posix_spawn(&pid_, binary.c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(in[0]), close(out[1]);
    stdin_ = in[1];
    stdout_ = out[0];
    if (error != 0) {
        pid_ = 0;
        return failed(std::strerror(error), "cannot start " + binary.string());
    }
    return proto::Done{};
}

proto::Status PrivateServer::wait_until_ready() {
    const auto deadline = Clock::now() + kReadyPatience;
    std::string text;
    while (Clock::now() < deadline && !is_interrupted()) {
        pollfd waiting{stdout_, POLLIN, 0};
        if (poll(&waiting, 1, 100) > 0) {
            char bytes[512];
            const ssize_t got = read(stdout_, bytes, sizeof bytes);
            if (got > 0) text.append(bytes, static_cast<std::size_t>(got));
        }
        if (const std::size_t end = text.find('\n'); end != std::string::npos) {
            const auto endpoint = endpoint_in_ready_line(text.substr(0, end));
            if (!endpoint) return failed("the private server's ready line is unknown: " + text.substr(0, end));
            endpoint_ = *endpoint;
            return proto::Done{};
        }
        if (const auto how = fate()) return failed("the private server " + *how);
    }
    return failed("the private server does not get ready: " + last_log_line());
}

std::optional<std::string> PrivateServer::fate() {
    if (pid_ == 0) return "was not started";
    int status = 0;
    if (!wait_status_ && waitpid(pid_, &status, WNOHANG) == pid_) wait_status_ = status;
    if (!wait_status_) return std::nullopt;
    std::string how = WIFSIGNALED(*wait_status_) ? "was ended by signal " + std::to_string(WTERMSIG(*wait_status_))
                                                 : "exited with status " + std::to_string(WEXITSTATUS(*wait_status_));
    if (const std::string line = last_log_line(); !line.empty()) how += ": " + line;
    return how;
}

std::string PrivateServer::last_log_line() const {
    std::ifstream log(folder_ / "log");
    std::string last;
    for (std::string line; std::getline(log, line);)
        if (!line.empty()) last = line;
    return last;
}

PrivateServer::~PrivateServer() {
    if (stdin_ >= 0) close(stdin_);
    const auto ends_within = [this](Clock::duration patience) {
        const auto deadline = Clock::now() + patience;
        while (!fate()) {
            if (Clock::now() > deadline) return false;
            std::this_thread::sleep_for(5ms);
        }
        return true;
    };
    if (pid_ > 0 && !ends_within(kEndPatience)) {
        kill(pid_, SIGTERM);
        if (!ends_within(kTermPatience)) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
    }
    if (stdout_ >= 0) close(stdout_);
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

}  // namespace headrace::client
