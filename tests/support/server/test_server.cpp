#include "tests/support/server/test_server.h"

#include <stdlib.h>

#include <stdexcept>

namespace headrace::test {

namespace fs = std::filesystem;

TempFolder::TempFolder() {
    // Short: an ipc path has 107 characters.
    std::string name = "/tmp/headrace-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder in /tmp");
    path_ = name;
}

TempFolder::~TempFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

TestServer::TestServer(Transport transport, int threads) {
    server::ServerOptions options;
    options.bind = transport == Transport::tcp ? "tcp://127.0.0.1:*" : "ipc://" + (folder_.path() / "s").string();
    options.data_folder = data_folder();
    options.threads = threads;
    options.log = server::Log(server::LogLevel::error);
    server_ = std::make_unique<server::Server>(options);
    server_->start();
}

TestServer::~TestServer() = default;

}  // namespace headrace::test
