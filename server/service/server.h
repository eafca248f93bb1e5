// A whole server: sockets, simulation, publisher and service thread, wired together. What main.cpp and the tests start.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "server/service/log.h"

namespace headrace::server {

struct ServerOptions {
    std::string bind{"tcp://127.0.0.1:5755"};  // see resolve_endpoints
    std::filesystem::path data_folder{"."};    // recordings go below it; made when missing
    int threads{0};                            // OpenMP team of the solver; 0: as many as the machine has
    Log log{};
};

class Server {
  public:
    // Binds all sockets. Throws std::runtime_error in words for the person who started it.
    explicit Server(const ServerOptions& options);
    ~Server();  // stop()

    void start();  // from here on it answers
    void stop();   // answers what waits with shutting_down, closes recordings, joins; idempotent

    // Readable once the server has ended by itself (server.shutdown); then call stop().
    int ended_fd() const;

    // As bound, with the ports that were taken.
    const std::string& control_endpoint() const;
    const std::string& events_endpoint() const;
    const std::string& frames_endpoint() const;
    const std::string& data_endpoint() const;
    const std::string& session() const;  // 16 hex digits

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace headrace::server
