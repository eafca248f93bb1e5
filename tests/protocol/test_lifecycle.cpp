// Start, end, who may reach the server, and bytes that mean nothing.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <random>
#include <string>

#include "server/service/endpoints.h"
#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;

namespace {

std::string start_error(const server::ServerOptions& options) {
    try {
        server::Server server(options);
        return "";
    } catch (const std::exception& failure) {
        return failure.what();
    }
}

std::string random_bytes(std::mt19937& random, std::size_t most) {
    std::string bytes(random() % most, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    return bytes;
}

// Sends bytes to a port without speaking ZeroMQ's protocol, and hangs up.
void send_raw(const std::string& endpoint, const std::string& bytes) {
    const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(server::port_of(endpoint).value()));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) [[maybe_unused]]
        const auto sent = ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    ::close(fd);
}

}  // namespace

TEST_CASE("Lifecycle.HelloTellsPortsOnTcpAndEndpointsOnIpc") {
    {
        TestServer server(Transport::tcp);
        Client client(server->control_endpoint());
        const Json hello = client.call("hello");
        CHECK(hello["data_port"] == server::port_of(server->data_endpoint()).value());
        CHECK(hello["frames_port"] == server::port_of(server->frames_endpoint()).value());
        CHECK_FALSE(hello.contains("events_endpoint"));
        CHECK(hello["session"] == server->session());
        CHECK(hello["threads"] == 1);
    }
    TestServer server;
    Client client(server->control_endpoint());
    const Json hello = client.call("hello");
    CHECK(hello["events_endpoint"] == server->events_endpoint());
    CHECK_FALSE(hello.contains("events_port"));
}

TEST_CASE("Lifecycle.DescribeNamesEveryMethodWithItsSchemas") {
    TestServer server;
    Client client(server->control_endpoint());
    const Json document = client.call("describe");
    CHECK(document["methods"].size() == 32);
    CHECK(document["components"]["schemas"].contains("shape"));  // where the schemas' references point
    for (const Json& method : document["methods"]) {
        INFO(method["name"]);
        CHECK(method["result"]["schema"]["type"] == "object");
        CHECK(method["x-params-schema"]["type"] == "object");
        CHECK(method["params"].size() == method["x-params-schema"]["properties"].size());
        CHECK_FALSE(method["summary"].get<std::string>().empty());
        // And it is one: whatever it answers, it is not that it does not exist.
        if (method["name"] != "server.shutdown")
            CHECK(client.ask(method["name"].get<std::string>()).error_name() != "method_not_found");
    }
    bool has_viscosity = false;
    for (const Json& parameter : document["x-models"]["thesis"]["parameters"])
        has_viscosity = has_viscosity || (parameter["name"] == "viscosity" && parameter["unit"] == "Pa s");
    CHECK(has_viscosity);
}

TEST_CASE("Lifecycle.OnlyLoopbackIsListenedOn") {
    for (const char* bind :
         {"tcp://0.0.0.0:*", "tcp://*:*", "tcp://lo:*", "tcp://192.0.2.1:*", "tcp://example.org:*"}) {
        server::ServerOptions options;
        options.bind = bind;
        INFO(bind);
        CHECK(start_error(options).find("ssh -L 5755:127.0.0.1:5755") != std::string::npos);
    }
}

TEST_CASE("Lifecycle.ATakenEndpointIsRefusedWithTheRemedy") {
    const TempFolder folder;
    TestServer tcp(Transport::tcp);
    server::ServerOptions options;
    options.data_folder = folder.path();
    options.bind = tcp->control_endpoint();
    const std::string error = start_error(options);
    CHECK(error.find(options.bind) != std::string::npos);
    CHECK(error.find("--bind") != std::string::npos);

    TestServer ipc;
    options.bind = ipc->control_endpoint();
    CHECK(start_error(options).find("another server listens") != std::string::npos);
    // The one that was there has not noticed.
    Client client(ipc->control_endpoint());
    CHECK(client.call("hello")["session"] == ipc->session());
}

TEST_CASE("Lifecycle.AnIpcPathIsFreeAgainAfterwards") {
    const TempFolder folder;
    server::ServerOptions options;
    options.bind = "ipc://" + (folder.path() / "s").string();
    options.data_folder = folder.path() / "data";
    for (int k = 0; k < 2; ++k) {
        server::Server server(options);
        server.start();
        Client client(server.control_endpoint());
        CHECK(client.call("hello")["session"] == server.session());
    }
    std::filesystem::remove_all(options.data_folder);
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("Lifecycle.ShutdownAnswersEveryoneWhoWaits") {
    TestServer server;
    Client client(server->control_endpoint()), other(server->control_endpoint()), data(server->data_endpoint());
    client.call("scene.load", {{"scene", pond()}});
    const std::int64_t run = other.post("sim.run", {{"pace", 1e-6}, {"wait", true}});
    REQUIRE(eventually([&] { return client.call("sim.status")["state"] == "running"; }));
    const std::int64_t job = other.post("job.wait", {{"job", 1}});
    const std::uint64_t last = client.call("events.since")["last_seq"];
    const std::int64_t poll =
        other.post("events.since", {{"seq", last}, {"timeout", 60}, {"types", Json::array({"object.added"})}});
    const std::int64_t stopping =
        other.post("events.since", {{"seq", last}, {"timeout", 60}, {"types", Json::array({"server.stopping"})}});
    const std::int64_t later = other.post("params.set", {{"parameters", {{"viscosity", 1}}}, {"at_step", 1000}});
    // In order: the server has all of the above once this is answered.
    other.call("sim.status", {{"hash", true}});

    CHECK(client.ask("server.shutdown").ok());
    for (std::int64_t id : {run, job, poll, later}) {
        INFO(id);
        CHECK(other.await(id).error_name() == "shutting_down");
    }
    CHECK(other.await(stopping).result()["events"].size() == 1);
    pollfd ended{server->ended_fd(), POLLIN, 0};
    CHECK(::poll(&ended, 1, 60'000) == 1);
}

TEST_CASE("Lifecycle.AServerEndsWhileALoadIsUnderWay") {
    TestServer server;
    Client client(server->control_endpoint());
    const std::int64_t load = client.post("scene.load", {{"scene", lake()}});
    REQUIRE(eventually([&] { return client.call("sim.status")["state"] == "loading"; }));
    server->stop();
    CHECK(client.await(load).error_name() == "shutting_down");
}

TEST_CASE("Lifecycle.RandomBytesOnEverySocketLeaveTheServerAlive") {
    const auto seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937 random(seed);
    TestServer server(Transport::tcp);
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});

    Peer control(zmq::socket_type::dealer, server->control_endpoint());
    Peer data(zmq::socket_type::dealer, server->data_endpoint());
    Peer events(zmq::socket_type::xsub, server->events_endpoint());
    Peer frames(zmq::socket_type::xsub, server->frames_endpoint());
    for (int k = 0; k < 200; ++k) {
        for (Peer* peer : {&control, &data}) {
            std::vector<std::string> parts(1 + random() % 4);
            for (std::string& part : parts) part = random_bytes(random, 300);
            peer->send_parts(parts);
        }
        // A subscription, its end, or neither.
        for (Peer* peer : {&events, &frames})
            peer->send(std::string(1, static_cast<char>(random() % 3)) + random_bytes(random, 40));
    }
    for (int k = 0; k < 20; ++k)
        for (const std::string& endpoint : {server->control_endpoint(), server->events_endpoint(),
                                            server->frames_endpoint(), server->data_endpoint()})
            send_raw(endpoint, random_bytes(random, 2000));

    CHECK(client.call("sim.step", {{"steps", 5}})["step"] == 5);
    Client reader(server->data_endpoint());
    CHECK(reader.call("frame.get")["step"] == 5);
}

TEST_CASE("Lifecycle.DamagedRequestsAreAnsweredOnceEach") {
    const auto seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937 random(seed);
    TestServer server;
    Client client(server->control_endpoint());
    const std::string sound[] = {
        Json{{"jsonrpc", "2.0"}, {"id", 5}, {"method", "scene.load"}, {"params", {{"scene", pond()}}}}.dump(),
        R"({"jsonrpc":"2.0","id":5,"method":"sim.run","params":{"until":{"steps":3},"pace":1000}})",
        R"({"jsonrpc":"2.0","id":5,"method":"stream.open","params":{"fields":["id"],"rate":5}})",
        R"({"jsonrpc":"2.0","id":5,"method":"params.set","params":{"parameters":{"viscosity":1e3}}})"};
    for (int k = 0; k < 400; ++k) {
        std::string text = sound[random() % std::size(sound)];
        for (int damage = 0; damage < 1 + k % 3; ++damage) text[random() % text.size()] = static_cast<char>(random());
        // Damage to the id member can make it a notification, which has no reply.
        if (text.find("\"id\":") == std::string::npos) continue;
        INFO(text);
        client.peer().send(text);
        const Json reply = Json::parse(client.peer().receive_parts("reply").back());
        CHECK(reply.contains("result") != reply.contains("error"));
    }
    CHECK(client.call("hello")["program"] == "headraced");
}
