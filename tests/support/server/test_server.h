// A server in this process, on endpoints of its own, for as long as the object lives.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "server/service/server.h"

namespace headrace::test {

// A folder that goes with the object.
class TempFolder {
  public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

enum class Transport { ipc, tcp };

class TestServer {
  public:
    explicit TestServer(Transport transport = Transport::ipc, int threads = 1);
    ~TestServer();

    server::Server& operator*() { return *server_; }
    server::Server* operator->() { return server_.get(); }
    const std::filesystem::path& folder() const { return folder_.path(); }         // holds data and ipc paths
    std::filesystem::path data_folder() const { return folder_.path() / "data"; }  // the server's --data

  private:
    TempFolder folder_;
    std::unique_ptr<server::Server> server_;
};

}  // namespace headrace::test
