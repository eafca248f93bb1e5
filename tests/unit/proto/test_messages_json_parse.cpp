#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "proto/messages_json.h"
#include "proto/presets.h"

using namespace headrace::proto;

namespace {

std::string nested(int depth) {
    return std::string(depth, '[') + std::string(depth, ']');
}

Error refusal_of(std::string_view text) {
    const auto parsed = parse_json(text);
    REQUIRE_FALSE(parsed.ok());
    return parsed.error();
}

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

}  // namespace

TEST_CASE("ParseJson.KeepsValuesAndOrder") {
    const auto parsed = parse_json(R"({"b": [1, -2, 2.5, true, null, "x\u00e9"], "a": {"c": {}}})");
    REQUIRE(parsed.ok());
    CHECK(parsed->dump() == "{\"b\":[1,-2,2.5,true,null,\"x\u00e9\"],\"a\":{\"c\":{}}}");
}

TEST_CASE("ParseJson.NestsToDepth32AndNoDeeper") {
    CHECK(parse_json(nested(32)).ok());
    CHECK(refusal_of(nested(33)).code == ErrorCode::json_too_deep);
    // Refused while reading: the rest, which never closes, does not matter.
    CHECK(refusal_of(std::string(1'000'000, '[')).code == ErrorCode::json_too_deep);
    std::string objects;
    for (int k = 0; k < 33; ++k) objects += "{\"a\":";
    CHECK(refusal_of(objects).code == ErrorCode::json_too_deep);
}

TEST_CASE("ParseJson.RefusesDuplicateKeysWithTheirPath") {
    const Error error = refusal_of(R"({"params": {"fluids": [{"name": "a"}, {"name": "b", "name": "c"}]}})");
    CHECK(error.code == ErrorCode::duplicate_key);
    CHECK(error.path == "params.fluids[1].name");
    CHECK(error.message == "member \"name\" is given twice");
    CHECK(refusal_of(R"({"a": [1, 2, ?]})").path == "a[2]");
    CHECK(refusal_of(R"({"a": 1, "\u0061": 2})").code == ErrorCode::duplicate_key);
    CHECK(parse_json(R"([{"a": 1}, {"a": 2}])").ok());
}

TEST_CASE("ParseJson.NamesLineAndColumn") {
    const Error error = refusal_of("{\n  \"a\": 1,\n  \"b\": ?\n}");
    CHECK(error.code == ErrorCode::parse_error);
    CHECK(contains(error.message, "line 3, column 8: "));
    CHECK(contains(refusal_of("").message, "nothing there"));
    CHECK(contains(refusal_of("{\"a\": [1, 2").message, "ends too early"));
}

TEST_CASE("ParseJson.RefusesWhatIsNoJson") {
    struct Slip {
        const char* text;
        const char* hint;
    };
    const Slip slip =
        GENERATE(Slip{"{\"a\": NaN}", "numbers must be finite"}, Slip{"{\"a\": Infinity}", "numbers must be finite"},
                 Slip{"{\"a\": -Infinity}", "numbers must be finite"}, Slip{"{\"a\": 1e999}", "numbers must be finite"},
                 Slip{"{'a': 1}", "strings and names stand in double quotes"},
                 Slip{"{\"a\": 1,}", "no comma before a closing bracket"},
                 Slip{"[1,]", "no comma before a closing bracket"}, Slip{"{\"a\": 1 // one\n}", "JSON has no comments"},
                 Slip{"{\"a\": True}", "true and false are written in small letters"});
    CAPTURE(slip.text);
    const Error error = refusal_of(slip.text);
    CHECK(error.code == ErrorCode::parse_error);
    CHECK(error.hint == slip.hint);
    INFO(error.message);
    CHECK(error.message.starts_with("line 1, column "));
}

TEST_CASE("ParseJson.RefusesTrailingTextAndBadUtf8") {
    CHECK(refusal_of("{} {}").code == ErrorCode::parse_error);
    CHECK(refusal_of("1 x").code == ErrorCode::parse_error);
    CHECK(refusal_of("{\"a\": \"\xff\"}").code == ErrorCode::parse_error);
    CHECK(refusal_of("{\"a\": \"\xc3\"}").code == ErrorCode::parse_error);          // cut in the middle of a letter
    CHECK(refusal_of("{\"a\": \"\xed\xa0\x80\"}").code == ErrorCode::parse_error);  // a surrogate
    // The message can be sent on.
    CHECK_NOTHROW(error_json(refusal_of("{\"a\": \"\xff\"}")).dump());
}

// Keys are compared by hashing: 200,000 of them in one object would take minutes when each is searched for.
TEST_CASE("ParseJson.TakesManyKeysInLinearTime") {
    std::string text = "{";
    for (int k = 0; k < 200'000; ++k) text += "\"k" + std::to_string(k) + "\":0,";
    text.back() = '}';
    const auto parsed = parse_json(text);
    REQUIRE(parsed.ok());
    CHECK(parsed->size() == 200'000);
}

TEST_CASE("ParseScene.SurvivesDamagedDocuments") {
    const auto seed = 20'100'331u;
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    const std::string event =
        R"({"seq":1,"type":"status","step":1,"time":0.5,"wall_clock":2.0,"message":"m","data":{"a":[1],"b":true}})";
    int refused = 0;
    for (int k = 0; k < 200; ++k) {
        std::string text(presets()[below(presets().size())].json);
        if (k % 2 == 0) text.resize(below(text.size()));
        for (std::size_t edits = below(8); edits-- > 0 && !text.empty();)
            text[below(text.size())] = k % 3 ? "{}[],:\"0-e.ntf"[below(14)] : static_cast<char>(below(256));
        const auto scene = parse_scene(text);
        if (!scene) {
            ++refused;
            CHECK_FALSE(scene.error().message.empty());
            CHECK_NOTHROW(error_json(scene.error()).dump());
        } else {
            CHECK(parse_scene(scene_text(*scene)).ok());
        }
        std::string damaged = event;
        damaged[below(damaged.size())] = static_cast<char>(below(256));
        if (const auto read = parse_event(damaged)) CHECK(parse_event(event_text(*read)).ok());
    }
    CHECK(refused >= 100);  // at least every cut-off text
}
