#include <catch2/catch.hpp>

#include "proto/envelope.h"

using namespace headrace::proto;

namespace {

constexpr std::size_t kLimit = 1000;

RpcRequest request(std::string_view text) {
    auto parsed = parse_rpc_request(text, kLimit);
    REQUIRE(std::holds_alternative<RpcRequest>(parsed));
    return std::get<RpcRequest>(parsed);
}

RpcRefusal refusal(std::string_view text) {
    CAPTURE(text);
    auto parsed = parse_rpc_request(text, kLimit);
    REQUIRE(std::holds_alternative<RpcRefusal>(parsed));
    return std::get<RpcRefusal>(parsed);
}

}  // namespace

TEST_CASE("Envelope.KeepsTheIdAsItCame") {
    CHECK(request(R"({"jsonrpc": "2.0", "id": 7, "method": "hello"})").id == "7");
    CHECK(request(R"({"jsonrpc": "2.0", "id": -9223372036854775808, "method": "a"})").id == "-9223372036854775808");
    CHECK(request(R"({"jsonrpc": "2.0", "id": "a\"b", "method": "a"})").id == R"("a\"b")");
    CHECK(request(R"({"jsonrpc": "2.0", "id": null, "method": "a"})").id == "null");
    CHECK_FALSE(request(R"({"jsonrpc": "2.0", "id": null, "method": "a"})").is_notification);
    CHECK(request(R"({"jsonrpc": "2.0", "method": "a"})").is_notification);
}

TEST_CASE("Envelope.GivesParamsAsAnObject") {
    const auto without = request(R"({"jsonrpc": "2.0", "id": 1, "method": "sim.pause"})");
    CHECK(without.method == "sim.pause");
    CHECK(without.params == Json::object());
    const auto with = request(R"({"jsonrpc": "2.0", "id": 1, "method": "sim.step", "params": {"steps": 4}})");
    CHECK(with.params["steps"] == 4);
}

TEST_CASE("Envelope.RefusesWhatIsNoRequestUnderItsId") {
    struct Case {
        const char* text;
        const char* id;
        const char* path;
    };
    const Case c = GENERATE(Case{R"([{"jsonrpc": "2.0", "id": 1, "method": "a"}])", "null", ""}, Case{"5", "null", ""},
                            Case{R"({"id": 4, "method": "a"})", "4", "jsonrpc"},
                            Case{R"({"jsonrpc": "1.0", "id": 4, "method": "a"})", "4", "jsonrpc"},
                            Case{R"({"jsonrpc": 2.0, "id": 4, "method": "a"})", "4", "jsonrpc"},
                            Case{R"({"jsonrpc": "2.0", "id": 1.5, "method": "a"})", "null", "id"},
                            Case{R"({"jsonrpc": "2.0", "id": {}, "method": "a"})", "null", "id"},
                            Case{R"({"jsonrpc": "2.0", "id": true, "method": "a"})", "null", "id"},
                            Case{R"({"jsonrpc": "2.0", "id": 4})", "4", "method"},
                            Case{R"({"jsonrpc": "2.0", "id": 4, "method": 4})", "4", "method"},
                            Case{R"({"jsonrpc": "2.0", "id": 4, "method": "a", "params": [1]})", "4", "params"},
                            Case{R"({"jsonrpc": "2.0", "id": 4, "method": "a", "params": null})", "4", "params"},
                            Case{R"({"jsonrpc": "2.0", "id": "x", "method": "a", "parms": {}})", "\"x\"", "parms"});
    const auto refused = refusal(c.text);
    CHECK(refused.id == c.id);
    CHECK(refused.error.code == ErrorCode::invalid_request);
    CHECK(refused.error.path == c.path);
    CHECK_FALSE(refused.error.message.empty());
    CHECK_FALSE(refused.error.hint.empty());
}

TEST_CASE("Envelope.HintsAtTheRemedy") {
    CHECK(refusal("[]").error.hint == "send one object per message");
    CHECK(refusal(R"({"jsonrpc": "2.0", "id": 4, "method": "a", "params": [1]})").error.hint ==
          "give parameters by name: {\"name\": value}");
    CHECK(refusal(R"({"jsonrpc": "2.0", "id": 4, "method": "a", "parms": {}})").error.hint ==
          "did you mean \"params\"?");
}

TEST_CASE("Envelope.HoldsTheLimits") {
    std::string text = R"({"jsonrpc": "2.0", "id": 4, "method": "a"})";
    text.resize(kLimit, ' ');
    CHECK(request(text).id == "4");
    text += ' ';
    CHECK(refusal(text).error.code == ErrorCode::message_too_large);
    CHECK(refusal("{").error.code == ErrorCode::parse_error);
    CHECK(refusal("").error.code == ErrorCode::parse_error);
    CHECK(refusal(R"({"id": 1, "id": 2})").error.code == ErrorCode::duplicate_key);
    CHECK(refusal(std::string(33, '[')).error.code == ErrorCode::json_too_deep);
}

TEST_CASE("Envelope.WritesReplies") {
    CHECK(rpc_result_text("\"a\"", Json{{"step", 4}}) == R"({"jsonrpc":"2.0","id":"a","result":{"step":4}})");
    CHECK(
        rpc_error_text("null", {ErrorCode::busy, "loading", "", "wait"}) ==
        R"({"jsonrpc":"2.0","id":null,"error":{"code":-32012,"message":"loading","data":{"name":"busy","hint":"wait","retryable":true}}})");
    // Bytes that are not UTF-8, from a file name for example, do not stop a reply.
    const std::string text = rpc_error_text("1", {ErrorCode::file_error, "no file \xff", "", ""});
    CHECK(parse_rpc_reply(text).ok());
}

TEST_CASE("Envelope.ClientAndServerUnderstandEachOther") {
    const auto asked = request(rpc_request_text(12, "sim.step", Json{{"steps", 3}}));
    CHECK(asked.id == "12");
    CHECK(asked.method == "sim.step");
    CHECK(asked.params["steps"] == 3);

    const auto good = parse_rpc_reply(rpc_result_text(asked.id, Json{{"step", 4}}));
    REQUIRE(good.ok());
    CHECK(good->id == 12);
    REQUIRE(good->result.ok());
    CHECK((*good->result)["step"] == 4);

    const auto bad =
        parse_rpc_reply(rpc_error_text(asked.id, {ErrorCode::wrong_state, "no scene", "params.x", "load"}));
    REQUIRE(bad.ok());
    CHECK(bad->id == 12);
    REQUIRE_FALSE(bad->result.ok());
    CHECK(bad->result.error().code == ErrorCode::wrong_state);
    CHECK(bad->result.error().path == "params.x");
    CHECK(bad->result.error().hint == "load");

    const auto unnamed = parse_rpc_reply(rpc_error_text("null", {ErrorCode::parse_error, "bad", "", ""}));
    REQUIRE(unnamed.ok());
    CHECK(unnamed->id == 0);
}

TEST_CASE("Envelope.RefusesRepliesThatAreNone") {
    const char* text =
        GENERATE("", "[]", "{}", R"({"jsonrpc": "2.0", "id": 1})", R"({"id": 1, "result": {}})",
                 R"({"jsonrpc": "2.0", "id": "a", "result": {}})", R"({"jsonrpc": "2.0", "id": null, "result": {}})",
                 R"({"jsonrpc": "2.0", "result": {}})", R"({"jsonrpc": "2.0", "id": 1, "result": {}, "error": {}})");
    CAPTURE(text);
    CHECK_FALSE(parse_rpc_reply(text).ok());
}
