// What is no request, and the promise that every request gets exactly one reply.
#include <catch2/catch.hpp>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <string>

#include "proto/errors.h"
#include "server/service/limits.h"
#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;

namespace {

std::string nested(int depth) {
    return R"({"jsonrpc":"2.0","id":1,"method":"hello","params":)" + std::string(depth, '[') + std::string(depth, ']') +
           "}";
}

}  // namespace

TEST_CASE("Requests.WhatIsNoRequestGetsItsErrorAndOneReply") {
    TestServer server;
    Client client(server->control_endpoint());
    const auto [text, name] = GENERATE(table<std::string, std::string>({
        {"", "parse_error"},
        {"\xff\xfe", "parse_error"},
        {"{\"jsonrpc\":", "parse_error"},
        {R"({"jsonrpc":"2.0","id":1,"method":"hello","params":{"x":NaN}})", "parse_error"},
        {nested(40), "json_too_deep"},
        {R"({"jsonrpc":"2.0","id":1,"method":"hello","method":"hello"})", "duplicate_key"},
        {R"([{"jsonrpc":"2.0","id":1,"method":"hello"}])", "invalid_request"},
        {R"({"id":1,"method":"hello"})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":1})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":1,"method":5})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":1.5,"method":"hello"})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":{},"method":"hello"})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":1,"method":"hello","params":[1]})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":1,"method":"hello","extra":1})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":1,"method":"Hello"})", "method_not_found"},
        {R"({"jsonrpc":"2.0","id":1,"method":"hello","params":{"x":1}})", "invalid_params"},
        {R"({"jsonrpc":"2.0","id":1,"method":"scene.load"})", "invalid_params"},
        {R"({"jsonrpc":"2.0","id":1,"method":"sim.step","params":{"steps":0}})", "invalid_params"},
        {R"({"jsonrpc":"2.0","id":1,"method":"sim.run","params":{"until":{"time":1,"steps":1}}})", "invalid_params"},
        {R"({"jsonrpc":"2.0","id":1,"method":"frame.get"})", "wrong_socket"},
        {R"({"jsonrpc":"2.0","id":1,"method":"stream.ack","params":{"stream":"x","seq":1}})", "wrong_socket"},
        {R"({"jsonrpc":"2.0","id":1,"method":"stream.open","params":{"mode":"lossless"}})", "wrong_socket"},
    }));
    INFO(text.substr(0, 200));
    const Answer answer = client.ask_raw(text);
    CHECK(answer.error_name() == name);
    // The next reply is the next request's: there was only one.
    CHECK(client.ask_raw(R"({"jsonrpc":"2.0","id":"next","method":"hello"})").message["id"] == "next");
}

TEST_CASE("Requests.ErrorsCarryTheCodeOfTheTable") {
    TestServer server;
    Client client(server->control_endpoint());
    const Json error = client.ask("no.such").message.at("error");
    CHECK(error["code"] == proto::error_info(proto::ErrorCode::method_not_found).rpc_code);
    CHECK(error["data"]["retryable"] == false);
    CHECK(client.ask("sim.pase").hint() == "did you mean \"sim.pause\"?");
    CHECK(client.ask("sim.step", {{"steps", "x"}}).path() == "params.steps");
}

TEST_CASE("Requests.IdsAreEchoedAsTheyCame") {
    TestServer server;
    Client client(server->control_endpoint());
    for (const char* id : {"7", "-1", "\"seven\"", "null", "\"\"", "9007199254740993"}) {
        const std::string text = std::string(R"({"jsonrpc":"2.0","method":"hello","id":)") + id + "}";
        CHECK(client.ask_raw(text).message["id"].dump() == id);
    }
}

TEST_CASE("Requests.ANotificationIsDoneAndNotAnswered") {
    TestServer server;
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});
    client.notify("objects.remove", {{"name", "tank"}});
    client.notify("no.such");
    client.notify("sim.status");
    // Commands of one client are applied in their order, so this reply would come after any to the notifications.
    const std::int64_t next = client.post("sim.status", {{"hash", true}});
    CHECK(client.receive().id() == next);
    CHECK(client.call("objects.list")["objects"].empty());
}

TEST_CASE("Requests.AboveTheSoftLimitIsAnsweredAboveTheHardLimitDisconnected") {
    TestServer server;
    Client client(server->control_endpoint());
    const std::string large(static_cast<std::size_t>(server::kSoftMessageLimit) + 1, ' ');
    CHECK(client.ask_raw(large).error_name() == "message_too_large");
    CHECK(client.call("hello")["soft_message_limit"] == server::kSoftMessageLimit);

    Client giant(server->control_endpoint());
    giant.peer().send(std::string(static_cast<std::size_t>(server::kHardMessageLimit) + 1, ' '));
    CHECK(client.call("hello")["program"] == "headraced");
}

TEST_CASE("Requests.AReqSocketWorksAndItsDelimiterComesBack") {
    TestServer server;
    Client req(server->control_endpoint(), zmq::socket_type::req);
    CHECK(req.call("hello")["program"] == "headraced");
    CHECK(req.ask("no.such").error_name() == "method_not_found");
    // A request that is answered later.
    CHECK(req.call("scene.load", {{"scene", pond()}})["particles"] == 100);

    Client dealer(server->control_endpoint());
    dealer.peer().send_parts({"", R"({"jsonrpc":"2.0","id":1,"method":"hello"})"});
    const auto parts = dealer.peer().receive_parts("reply");
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].empty());
}

TEST_CASE("Requests.MessagesWithOtherPartCountsAreRefused") {
    TestServer server;
    Client client(server->control_endpoint());
    for (const auto& parts : {std::vector<std::string>{"{}", "{}"}, {"", "{}", "{}"}, {"a", "b", "c", "d"}}) {
        client.peer().send_parts(parts);
        const auto reply = client.peer().receive_parts("reply");
        CHECK(Json::parse(reply.back())["error"]["data"]["name"] == "invalid_request");
    }
    CHECK(client.call("hello")["program"] == "headraced");
}

TEST_CASE("Requests.AThousandMixedRequestsGetOneReplyEach") {
    const auto seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937 random(seed);
    TestServer server;
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});

    std::set<std::int64_t> open;
    int without_id = 0;
    for (int k = 0; k < 1000; ++k) {
        switch (random() % 12) {
            case 0:
                open.insert(client.post("hello"));
                break;
            case 1:
                open.insert(client.post("sim.status"));
                break;
            case 2:
                open.insert(client.post("sim.step", {{"steps", 1 + random() % 3}}));
                break;
            case 3:
                open.insert(client.post("params.set", {{"parameters", {{"viscosity", 1.0}}}}));
                break;
            case 4:
                open.insert(client.post("objects.move", {{"name", "tank"}, {"by", {0, 0}}}));
                break;
            case 5:
                open.insert(client.post("no.such"));
                break;
            case 6:
                open.insert(client.post("sim.pause", {{"x", 1}}));
                break;
            case 7:
                open.insert(client.post("events.since", {{"timeout", 0.001}}));
                break;
            case 8:
                open.insert(client.post("stream.close", {{"stream", "none"}}));
                break;
            case 9:
                open.insert(client.post("sim.status", {{"hash", true}}));
                break;
            case 10:
                client.notify(random() % 2 == 0 ? "sim.status" : "no.such");
                break;
            default:
                client.peer().send(random() % 2 == 0 ? "{" : "[]");
                ++without_id;
        }
    }
    while (!open.empty() || without_id > 0) {
        const Answer answer = client.receive();
        if (answer.message["id"].is_null()) {
            --without_id;
            REQUIRE(without_id >= 0);
        } else {
            INFO(answer.message.dump());
            REQUIRE(open.erase(answer.id()) == 1);
        }
    }
    // Through the service, the simulation and the publisher: whatever was left would come before these.
    CHECK(client.receive_in_order({client.post("sim.status", {{"hash", true}})}));
    CHECK(client.receive_in_order({client.post("stream.close", {{"stream", "none"}})}));
}

TEST_CASE("Requests.TwoClientsGetTheirOwnReplies") {
    TestServer server;
    Client one(server->control_endpoint()), two(server->control_endpoint());
    one.call("scene.load", {{"scene", pond()}});
    std::vector<std::int64_t> first, second;
    for (int k = 0; k < 200; ++k) {
        first.push_back(one.post("objects.move", {{"name", "tank"}, {"by", {0, 0}}}));
        second.push_back(two.post("objects.list"));
    }
    for (std::int64_t id : first) CHECK(one.await(id).result().contains("step"));
    for (std::int64_t id : second) CHECK(two.await(id).result().contains("objects"));
}

TEST_CASE("Requests.AnAnswerToAPeerThatHasGoneIsDropped") {
    TestServer server;
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});
    {
        Client hasty(server->control_endpoint());
        hasty.call("hello");
        for (int k = 0; k < 50; ++k) hasty.post("sim.run", {{"until", {{"steps", 1}}}, {"wait", true}});
    }
    CHECK(client.call("hello")["program"] == "headraced");
}
