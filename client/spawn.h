// A headraced of our own, on an ipc endpoint in a private folder. It lives as long as this object.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "proto/result.h"

namespace headrace::client {

// HEADRACE_SERVER_BINARY, else beside this program, else ../server/ from it (a build tree), else on the PATH.
std::optional<std::filesystem::path> find_server_binary();

// The control endpoint in a ready line (JSON), if it is one.
std::optional<std::string> endpoint_in_ready_line(const std::string& line);

class PrivateServer {
  public:
    // Returns when the server listens. `threads`: of the solver; 0: as many as the machine has. `data_folder`: where
    // scenes have their files and recordings go; empty: the private folder, which goes with the server.
    static proto::Result<std::unique_ptr<PrivateServer>> start(int threads,
                                                               const std::filesystem::path& data_folder = {});
    // Ends the server by closing its standard input; kills it by its pid when it takes too long. Removes the folder.
    ~PrivateServer();
    PrivateServer(const PrivateServer&) = delete;
    PrivateServer& operator=(const PrivateServer&) = delete;

    const std::string& endpoint() const { return endpoint_; }

    // How it ended ("exited with status 1: ..."), with the last line of its log; nothing while it lives.
    std::optional<std::string> fate();

  private:
    PrivateServer() = default;
    proto::Status spawn(const std::filesystem::path& binary, int threads, const std::filesystem::path& data_folder);
    proto::Status wait_until_ready();
    std::string last_log_line() const;

    std::filesystem::path folder_;  // mode 0700
    std::string endpoint_;
    pid_t pid_{0};
    int stdin_{-1};   // write end; closing it tells the server to end
    int stdout_{-1};  // read end; kept open so that the server can write
    std::optional<int> wait_status_;
};

}  // namespace headrace::client
