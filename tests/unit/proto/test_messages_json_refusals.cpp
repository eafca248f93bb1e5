#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "proto/messages_json.h"

using namespace headrace::proto;

namespace {

template <class Message>
Error refusal(const char* text) {
    CAPTURE(text);
    const auto json = parse_json(text);
    REQUIRE(json.ok());
    const auto message = from_json<Message>(*json, "params");
    REQUIRE_FALSE(message.ok());
    CHECK(message.error().code == ErrorCode::invalid_params);
    return message.error();
}

template <class Message>
bool is_taken(const char* text) {
    const auto json = parse_json(text);
    REQUIRE(json.ok());
    return from_json<Message>(*json, "params").ok();
}

// "path: message (hint)"
template <class Message>
std::string why(const char* text) {
    const Error error = refusal<Message>(text);
    return error.path + ": " + error.message + (error.hint.empty() ? "" : " (" + error.hint + ")");
}

}  // namespace

TEST_CASE("Refusal.NamesExpectedKindUnitAndWhatWasGot") {
    CHECK(why<SimRun>(R"({"pace": "fast"})") == R"(params.pace: must be a number, got the string "fast")");
    CHECK(why<SimRun>(R"({"until": {"time": true}})") == "params.until.time: must be a number [s], got true");
    CHECK(why<SimRun>(R"({"until": []})") == "params.until: must be an object, got an array of 0");
    CHECK(why<SimRun>("[1]") == "params: must be an object, got an array of 1");
    CHECK(why<SimRun>(R"({"wait": 1})") == "params.wait: must be true or false, got 1");
    CHECK(why<ObjectsRemove>(R"({"name": 7})") == "params.name: must be a string, got 7");
    CHECK(why<ParamsGet>(R"({"names": {}})") == "params.names: must be an array, got an object");
    CHECK(why<SimRun>(R"({"pace": null})") ==
          "params.pace: must be a number, got null (leave the member out instead of giving null)");
}

TEST_CASE("Refusal.NamesRangesWithUnits") {
    CHECK(why<SimRun>(R"({"until": {"duration": -0.5}})") ==
          "params.until.duration: must be greater than 0 s, got -0.5");
    CHECK(why<SimStep>(R"({"steps": 0})") == "params.steps: must be at least 1 and at most 1000000000000000, got 0");
    CHECK(why<StreamOpen>(R"({"mode": "lossless", "window": 1025})") ==
          "params.window: must be at least 1 and at most 1024, got 1025");
    CHECK(is_taken<StreamOpen>(R"({"mode": "lossless", "window": 1024})"));
    CHECK(is_taken<StreamOpen>(R"({"mode": "lossless", "window": 1})"));
    CHECK(refusal<StreamOpen>(R"({"mode": "lossless", "window": 0})").path == "params.window");
    CHECK(refusal<EventsSince>(R"({"timeout": -1})").path == "params.timeout");
    CHECK(is_taken<EventsSince>(R"({"timeout": 0})"));
    CHECK(refusal<JobWait>(R"({"job": 1, "timeout": 1e300})").path == "params.timeout");
}

TEST_CASE("Refusal.TakesIntegersOnlyWhenExact") {
    CHECK(is_taken<SimStep>(R"({"steps": 1e3})"));
    CHECK(is_taken<SimStep>(R"({"steps": 2.0})"));
    CHECK(why<SimStep>(R"({"steps": 2.5})") == "params.steps: must be an integer, got 2.5");
    CHECK(refusal<SimStep>(R"({"steps": 1e18})").path == "params.steps");
    CHECK(refusal<SimStep>(R"({"steps": 18446744073709551615})").message == "is too large, got 18446744073709551615");
    CHECK(why<EventsSince>(R"({"seq": -1})") == "params.seq: must be at least 0, got -1");
    CHECK(why<EventsSince>(R"({"seq": -1.0})") == "params.seq: must be at least 0, got -1.0");
    CHECK(refusal<FaultReport>(R"({"criterion": "c", "particle": 4294967296})").path == "params.particle");
}

TEST_CASE("Refusal.SuggestsTheMemberThatWasMeant") {
    CHECK(why<SimRun>(R"({"untill": {}})") == R"(params.untill: unknown member "untill" (did you mean "until"?))");
    CHECK(why<SimRun>(R"({"until": {"tiem": 1}})") ==
          R"(params.until.tiem: unknown member "tiem" (did you mean "time"?))");
    // A misspelt name says more than its absence.
    CHECK(why<ObjectsRemove>(R"({"nmae": "panel"})") == R"(params.nmae: unknown member "nmae" (did you mean "name"?))");
    CHECK(why<ObjectsMove>(R"({"name": "a", "too": [0, 0]})") ==
          R"(params.too: unknown member "too" (did you mean "to"?))");
    CHECK(why<SimPause>(R"({"x": 1})") == R"(params.x: unknown member "x")");
    CHECK(refusal<SimPause>(R"({"a b": 1})").path == R"(params["a b"])");
}

TEST_CASE("Refusal.NamesWhatIsMissing") {
    CHECK(why<ObjectsRemove>("{}") == "params.name: is missing");
    CHECK(why<ObjectsAdd>(R"({"object": {"name": "a"}})") == "params.object.shape: is missing");
    CHECK(why<Applied>(R"({"step": 1})") == "params.time: is missing");
}

TEST_CASE("Refusal.HoldsTargetsOfARunApart") {
    CHECK(why<SimRun>(R"({"until": {"time": 1, "steps": 4}})") ==
          "params.until.steps: cannot be given together with time (give one of time, duration, step, steps, at_rest, "
          "probe)");
    CHECK(refusal<SimRun>(R"({"until": {"at_rest": true, "duration": 4}})").path == "params.until.at_rest");
    CHECK(why<SimRun>(R"({"until": {"at_rest": false}})") ==
          "params.until.at_rest: must be true, got false (leave the member out instead)");
    CHECK(is_taken<SimRun>(R"({"until": {"at_rest": true, "timeout": 4}})"));
    CHECK(is_taken<SimRun>(R"({"until": {}})"));
}

TEST_CASE("Refusal.MovesEitherToOrBy") {
    CHECK(why<ObjectsMove>(R"({"name": "a"})") == "params: needs one of to, by");
    CHECK(refusal<ObjectsMove>(R"({"name": "a", "to": [0, 0], "by": [1, 1]})").path == "params.by");
}

TEST_CASE("Refusal.KeepsLiveAndLosslessStreamsApart") {
    CHECK(why<StreamOpen>(R"({"mode": "lossless", "rate": 5})") ==
          R"(params.rate: is for mode "live" only (leave it out, or set mode to "live"))");
    for (const char* text :
         {R"({"interval": 0.1})", R"({"every_steps": 1})", R"({"window": 4})", R"({"on_stall": "fail"})",
          R"({"stall_timeout": 1})", R"({"resume": "1"})", R"({"mode": "live", "acked": 1})"})
        CHECK(refusal<StreamOpen>(text).message == "is for mode \"lossless\" only");
    CHECK(refusal<StreamOpen>(R"({"mode": "lossless", "interval": 1, "every_steps": 2})").path == "params.every_steps");
    CHECK(why<StreamOpen>(R"({"mode": "lossless", "acked": 2})") == "params.acked: needs resume beside it");
    CHECK(refusal<RecordStart>(R"({"file": "a.mcap", "interval": 1, "every_steps": 2})").path == "params.every_steps");
}

TEST_CASE("Refusal.NamesKnownChoices") {
    CHECK(why<StreamOpen>(R"({"mode": "losless"})") ==
          R"(params.mode: must be one of live, lossless, got "losless" (did you mean "lossless"?))");
    CHECK(why<StreamOpen>(R"({"mode": 3})") == "params.mode: must be one of live, lossless, got 3");
    CHECK(why<FrameGet>(R"({"fields": ["id", "presure"]})") ==
          R"(params.fields[1]: unknown field "presure" (did you mean "pressure"?))");
    CHECK(why<FrameGet>(R"({"fields": ["id", "id"]})") == R"(params.fields[1]: field "id" is named twice)");
    CHECK(why<FrameGet>(R"({"fields": []})") == "params.fields: must have at least 1 fields");
    CHECK(why<FrameGet>(R"({"fields": "id"})") ==
          R"(params.fields: must be an array of field names, got the string "id")");
}

TEST_CASE("Refusal.ChecksTexts") {
    const std::string longest(64, 'n');
    CHECK(is_taken<ObjectsRemove>((R"({"name": ")" + longest + R"("})").c_str()));
    CHECK(refusal<ObjectsRemove>((R"({"name": ")" + longest + R"(n"})").c_str()).path == "params.name");
    for (const char* text : {R"({"name": ""})", R"({"name": "a b"})", R"({"name": "a/b"})", R"({"name": "\u00e9"})"})
        CHECK(refusal<ObjectsRemove>(text).path == "params.name");
    for (const char* text :
         {R"({"file": "a.mca"})", R"({"file": ".mcap"})", R"({"file": "a\u0000.mcap"})", R"({"file": ""})"})
        CHECK(refusal<RecordStart>(text).path == "params.file");
}

TEST_CASE("Refusal.ChecksParameterValues") {
    CHECK(why<ParamsSet>(R"({"parameters": {}})") == "params.parameters: must have at least 1 parameters");
    CHECK(why<ParamsSet>(R"({"parameters": {"gravity": [1, 2, 3, 4]}})") ==
          "params.parameters.gravity: must be an array of 2 or 3 numbers, got an array of 4");
    CHECK(why<ParamsSet>(R"({"parameters": {"gravity": [0, "x"]}})") ==
          R"(params.parameters.gravity[1]: must be a number, got the string "x")");
    CHECK(refusal<ParamsSet>(R"({"parameters": {"a": null}})").path == "params.parameters.a");
    CHECK(refusal<ParamsSet>(R"({"parameters": {"a b": 1}})").path == R"(params.parameters["a b"])");
    CHECK(refusal<ParamsSet>(R"({"parameters": [1]})").path == "params.parameters");
}

TEST_CASE("Refusal.TakesASceneByNameOrAsDocument") {
    CHECK(why<SceneLoad>(R"({"scene": 3})") == "params.scene: must be a name or an object, got 3");
    CHECK(why<SceneLoad>(R"({"scene": "dam break"})") ==
          R"(params.scene: must be 1 to 64 letters, digits, _ . or -, got "dam break")");
    CHECK(refusal<SceneLoad>(R"({"scene": {}})").path == "params.scene.headrace_scene");
}
