#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "proto/envelope.h"
#include "server/service/command_table.h"

using namespace headrace;
using proto::ErrorCode;
using proto::Json;
using proto::Result;
using proto::SimState;
using server::CommandTable;
using server::Responder;

namespace {

// A table with no server behind it, and where its replies end up.
struct Bench {
    SimState state{SimState::idle};
    std::vector<Json> replies;
    std::vector<std::string> reported;  // "method" or "method: error name"
    CommandTable table{[this] { return state; },
                       [this](const server::CallReport& call) {
                           std::string line = call.method;
                           if (call.error != nullptr) line.append(": ").append(call.error->name());
                           reported.push_back(line);
                       }};

    void ask(const std::string& text) {
        table.handle(text, [this](const std::string& reply) { replies.push_back(Json::parse(reply)); });
    }
    std::string only_error() {
        REQUIRE(replies.size() == 1);
        REQUIRE(replies[0].contains("error"));
        return replies[0]["error"]["data"]["name"];
    }
};

std::string request(const std::string& method, const std::string& params = "{}") {
    return R"({"jsonrpc":"2.0","id":7,"method":")" + method + R"(","params":)" + params + "}";
}

}  // namespace

TEST_CASE("CommandTable.UnknownCommandGetsOneReplyWithASuggestion") {
    Bench bench;
    bench.table.add<proto::SimStatus>("sim.status", {}, [](proto::SimStatus, Responder&) {});
    bench.ask(request("sim.statsu"));
    CHECK(bench.only_error() == "method_not_found");
    CHECK(bench.replies[0]["id"] == 7);
    CHECK(bench.replies[0]["error"]["data"]["hint"] == "did you mean \"sim.status\"?");
}

TEST_CASE("CommandTable.HandlersSeeStructsNotJson") {
    Bench bench;
    bench.table.add<proto::SimStep>("sim.step", {}, [](const proto::SimStep& params, Responder& responder) {
        responder.reply(Json{{"steps", params.steps}});
    });
    bench.ask(request("sim.step", R"({"steps":12})"));
    REQUIRE(bench.replies.size() == 1);
    CHECK(bench.replies[0] == Json::parse(R"({"jsonrpc":"2.0","id":7,"result":{"steps":12}})"));
    CHECK(bench.reported == std::vector<std::string>{"sim.step"});
}

TEST_CASE("CommandTable.BadParamsNameThePathAndNeverReachTheHandler") {
    Bench bench;
    bool was_called = false;
    bench.table.add<proto::SimStep>("sim.step", {}, [&](const proto::SimStep&, Responder&) { was_called = true; });
    bench.ask(request("sim.step", R"({"steps":"many"})"));
    CHECK(bench.only_error() == "invalid_params");
    CHECK(bench.replies[0]["error"]["data"]["path"] == "params.steps");
    CHECK_FALSE(was_called);
}

TEST_CASE("CommandTable.AForgottenRequestIsAnsweredByItself") {
    Bench bench;
    bench.table.add<proto::SimStep>("sim.step", {}, [](const proto::SimStep&, Responder&) {});
    bench.ask(request("sim.step"));
    CHECK(bench.only_error() == "internal_error");
    CHECK(bench.reported == std::vector<std::string>{"sim.step: internal_error"});
}

TEST_CASE("CommandTable.AnExceptionBecomesOneInternalError") {
    Bench bench;
    bench.table.add<proto::SimStep>("sim.step", {},
                                    [](const proto::SimStep&, Responder&) { throw std::runtime_error("out of luck"); });
    bench.table.add<proto::SimPause>("sim.pause", {}, [](const proto::SimPause&, Responder& responder) {
        responder.reply(Json::object());
        throw std::runtime_error("too late");
    });
    bench.ask(request("sim.step"));
    CHECK(bench.only_error() == "internal_error");
    CHECK(bench.replies[0]["error"]["message"] == "out of luck");
    bench.ask(request("sim.pause"));
    REQUIRE(bench.replies.size() == 2);
    CHECK(bench.replies[1].contains("result"));
}

TEST_CASE("CommandTable.AnAnswerMayComeLaterAndComesOnce") {
    Bench bench;
    std::unique_ptr<Responder> kept;
    bench.table.add<proto::SimStep>("sim.step", {}, [&](const proto::SimStep&, Responder& responder) {
        kept = std::make_unique<Responder>(std::move(responder));
    });
    bench.ask(request("sim.step"));
    CHECK(bench.replies.empty());
    kept->reply(Json::object());
    CHECK_FALSE(kept->is_open());
    kept.reset();
    CHECK(bench.replies.size() == 1);
}

TEST_CASE("CommandTable.ANotificationIsDoneAndNotAnswered") {
    Bench bench;
    int calls = 0;
    bench.table.add<proto::SimPause>("sim.pause", {}, [&](const proto::SimPause&, Responder& responder) {
        ++calls;
        responder.reply(Json::object());
    });
    bench.ask(R"({"jsonrpc":"2.0","method":"sim.pause"})");
    bench.ask(R"({"jsonrpc":"2.0","method":"no.such"})");
    bench.ask(R"({"jsonrpc":"2.0","method":"sim.pause","params":{"x":1}})");
    CHECK(calls == 1);
    CHECK(bench.replies.empty());
    CHECK(bench.reported.size() == 3);
}

TEST_CASE("CommandTable.QueriesAskTheStateTable") {
    Bench bench;
    int calls = 0;
    bench.table.add_query<proto::ObjectsList, proto::ObjectsListReply>(
        "objects.list", {}, [&](const proto::ObjectsList&) -> Result<proto::ObjectsListReply> {
            ++calls;
            return proto::ObjectsListReply{};
        });
    bench.state = SimState::empty;
    bench.ask(request("objects.list"));
    CHECK(bench.only_error() == "wrong_state");
    bench.state = SimState::idle;
    bench.ask(request("objects.list"));
    CHECK(bench.replies.back().contains("result"));
    CHECK(calls == 1);
}

TEST_CASE("CommandTable.DataMethodsAreSentToTheDataSocket") {
    Bench bench;
    bench.table.add<proto::FrameGet>("frame.get", {}, [](const proto::FrameGet&, Responder&) { FAIL("was called"); });
    bench.ask(request("frame.get"));
    CHECK(bench.only_error() == "wrong_socket");
    const std::string hint = bench.replies[0]["error"]["data"]["hint"];
    CHECK(hint.find("data port") != std::string::npos);
}

TEST_CASE("CommandTable.WhatIsNoRequestIsRefusedOnce") {
    Bench bench;
    const auto [text, name] = GENERATE(table<std::string, std::string>({
        {"", "parse_error"},
        {"{", "parse_error"},
        {"[]", "invalid_request"},
        {"7", "invalid_request"},
        {R"({"jsonrpc":"1.0","id":1,"method":"hello"})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":1.5,"method":"hello"})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":1})", "invalid_request"},
        {R"({"jsonrpc":"2.0","id":1,"id":2,"method":"hello"})", "duplicate_key"},
    }));
    INFO(text);
    bench.ask(text);
    CHECK(bench.only_error() == name);
}

TEST_CASE("CommandTable.RefusingKeepsTheRequestsId") {
    Bench bench;
    const auto sink = [&](const std::string& reply) { bench.replies.push_back(Json::parse(reply)); };
    bench.table.refuse(request("hello"), {ErrorCode::shutting_down, "the server is ending", "", ""}, sink);
    CHECK(bench.only_error() == "shutting_down");
    CHECK(bench.replies[0]["id"] == 7);
    bench.table.refuse(R"({"jsonrpc":"2.0","method":"hello"})", {ErrorCode::shutting_down, "", "", ""}, sink);
    CHECK(bench.replies.size() == 1);
}
