#include <stdlib.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "server/service/endpoints.h"

using namespace headrace;
using server::resolve_endpoints;
namespace fs = std::filesystem;

namespace {

struct Folder {
    Folder() {
        std::string name = "/tmp/headrace-XXXXXX";
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
        path = name;
    }
    ~Folder() { fs::remove_all(path); }
    fs::path path;
};

}  // namespace

TEST_CASE("Endpoints.TcpTakesThePortAndTheNextThree") {
    const auto endpoints = resolve_endpoints("tcp://127.0.0.1:5755");
    REQUIRE(endpoints);
    CHECK_FALSE(endpoints->is_ipc);
    CHECK(endpoints->control == "tcp://127.0.0.1:5755");
    CHECK(endpoints->events == "tcp://127.0.0.1:5756");
    CHECK(endpoints->frames == "tcp://127.0.0.1:5757");
    CHECK(endpoints->data == "tcp://127.0.0.1:5758");
}

TEST_CASE("Endpoints.StarTakesFourFreePorts") {
    const auto endpoints = resolve_endpoints("tcp://localhost:*");
    REQUIRE(endpoints);
    CHECK(endpoints->control == "tcp://127.0.0.1:*");
    CHECK(endpoints->data == "tcp://127.0.0.1:*");
}

TEST_CASE("Endpoints.LoopbackInEverySpellingIsTaken") {
    for (const char* bind :
         {"tcp://127.0.0.1:1", "tcp://127.255.3.4:65532", "tcp://[::1]:5755", "tcp://localhost:5755"}) {
        INFO(bind);
        CHECK(resolve_endpoints(bind).ok());
    }
}

TEST_CASE("Endpoints.WhatOthersCanReachIsRefusedWithTheTunnel") {
    for (const char* bind :
         {"tcp://0.0.0.0:5755", "tcp://*:5755", "tcp://eth0:5755", "tcp://lo:5755", "tcp://192.168.1.4:5755",
          "tcp://[::]:5755", "tcp://example.org:5755", "tcp://127.0.0.1.example.org:5755", "tcp://128.0.0.1:5755",
          "tcp://127.1:5755", "tcp://127.0.0.1;0.0.0.0:5755", "tcp://:5755", "tcp://[::ffff:10.0.0.1]:5755"}) {
        INFO(bind);
        const auto endpoints = resolve_endpoints(bind);
        REQUIRE_FALSE(endpoints.ok());
        CHECK(endpoints.error().hint.find("ssh -L 5755:127.0.0.1:5755") != std::string::npos);
    }
}

TEST_CASE("Endpoints.PortsOutOfRangeAreRefused") {
    for (const char* bind : {"tcp://127.0.0.1:0", "tcp://127.0.0.1:65533", "tcp://127.0.0.1:x", "tcp://127.0.0.1:-1",
                             "tcp://127.0.0.1:", "tcp://127.0.0.1:57 55", "tcp://127.0.0.1", "udp://127.0.0.1:1",
                             "127.0.0.1:5755", "", "inproc://x", "ipc://", "ipc://*", "ipc://@abstract"}) {
        INFO(bind);
        CHECK_FALSE(resolve_endpoints(bind).ok());
    }
}

TEST_CASE("Endpoints.IpcPathsFitTheSystem") {
    // The longest of the four has 7 characters more (".events"); the system takes 107.
    const std::string longest = "ipc:///" + std::string(99, 'x');
    const auto fits = resolve_endpoints(longest);
    REQUIRE(fits);
    CHECK(fits->events == longest + ".events");
    const auto too_long = resolve_endpoints(longest + "x");
    REQUIRE_FALSE(too_long.ok());
    CHECK(too_long.error().message.find("107") != std::string::npos);
}

TEST_CASE("Endpoints.PortIsReadBack") {
    CHECK(server::port_of("tcp://127.0.0.1:5755") == 5755);
    CHECK(server::port_of("tcp://[::1]:80") == 80);
    CHECK_FALSE(server::port_of("ipc:///tmp/x:5"));
}

TEST_CASE("IpcLock.OneServerAPath") {
    const Folder folder;
    const auto endpoints = resolve_endpoints("ipc://" + (folder.path / "s").string());
    REQUIRE(endpoints);
    {
        const auto first = server::IpcLock::take(*endpoints);
        REQUIRE(first.ok());
        const auto second = server::IpcLock::take(*endpoints);
        REQUIRE_FALSE(second.ok());
        CHECK(second.error().message.find("another server listens") != std::string::npos);
    }
    CHECK(server::IpcLock::take(*endpoints).ok());
    CHECK(fs::is_empty(folder.path));
}

TEST_CASE("IpcLock.NeverTakesAFileThatIsNoSocket") {
    const Folder folder;
    const auto endpoints = resolve_endpoints("ipc://" + (folder.path / "notes").string());
    REQUIRE(endpoints);
    std::ofstream(folder.path / "notes.data") << "precious";
    const auto lock = server::IpcLock::take(*endpoints);
    REQUIRE_FALSE(lock.ok());
    CHECK(lock.error().message.find("notes.data") != std::string::npos);
    CHECK(fs::file_size(folder.path / "notes.data") == 8);
}

TEST_CASE("IpcLock.AMissingFolderIsToldApart") {
    const Folder folder;
    const auto endpoints = resolve_endpoints("ipc://" + (folder.path / "missing" / "s").string());
    REQUIRE(endpoints);
    const auto lock = server::IpcLock::take(*endpoints);
    REQUIRE_FALSE(lock.ok());
    CHECK(lock.error().message.find("No such file") != std::string::npos);
}
