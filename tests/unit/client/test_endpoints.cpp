#include <catch2/catch.hpp>

#include "client/endpoints.h"
#include "client/spawn.h"

using namespace headrace;
using namespace headrace::client;

TEST_CASE("Endpoints.DataSocketKeepsTheClientsHost") {
    proto::HelloReply hello;
    hello.data_port = 5758;
    CHECK(*data_endpoint("tcp://127.0.0.1:5755", hello) == "tcp://127.0.0.1:5758");
    CHECK(*data_endpoint("tcp://workstation.example:6000", hello) == "tcp://workstation.example:5758");
    CHECK(*data_endpoint("tcp://[::1]:5755", hello) == "tcp://[::1]:5758");
}

TEST_CASE("Endpoints.IpcComesWhole") {
    proto::HelloReply hello;
    hello.data_endpoint = "ipc:///run/h/s.data";
    CHECK(*data_endpoint("ipc:///run/h/s", hello) == "ipc:///run/h/s.data");
}

TEST_CASE("Endpoints.MissingDataSocketIsSaid") {
    const auto missing = data_endpoint("tcp://127.0.0.1:5755", proto::HelloReply{});
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == proto::ErrorCode::connection_failed);
}

TEST_CASE("Endpoints.OptionComesFirst") {
    CHECK(control_endpoint("tcp://10.0.0.1:1") == "tcp://10.0.0.1:1");
    CHECK(is_server_chosen("tcp://10.0.0.1:1"));
}

TEST_CASE("Endpoints.ReadyLineTellsWhereThePrivateServerListens") {
    CHECK(endpoint_in_ready_line(R"({"control":"ipc:///x/s","events":"ipc:///x/e"})") == "ipc:///x/s");
    CHECK_FALSE(endpoint_in_ready_line("control tcp://127.0.0.1:5755"));
    CHECK_FALSE(endpoint_in_ready_line(R"({"control":5755})"));
    CHECK_FALSE(endpoint_in_ready_line("[]"));
}
