#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "proto/messages_json.h"
#include "proto/methods.h"
#include "tests/support/schema_files.h"

using namespace headrace::proto;

namespace {

Json load(const std::string& file) {
    std::ifstream stream(headrace::test::schema_folder() / file);
    REQUIRE(stream);
    std::stringstream text;
    text << stream.rdbuf();
    auto parsed = parse_json(text.str());
    REQUIRE(parsed.ok());
    return *parsed;
}

// The message that a JSON text says, written again.
template <class Message>
std::string again(const Json& json) {
    const auto message = from_json<Message>(json, "params");
    if (!message) return message.error().path + ": " + message.error().message;
    return to_json(*message).dump();
}

template <class Message>
std::string again(const char* text) {
    auto json = parse_json(text);
    REQUIRE(json.ok());
    return again<Message>(*json);
}

template <class Message>
Message read(const char* text) {
    auto json = parse_json(text);
    REQUIRE(json.ok());
    auto message = from_json<Message>(*json, "params");
    if (!message) FAIL(message.error().path << ": " << message.error().message);
    return *message;
}

}  // namespace

TEST_CASE("Messages.ExamplesRoundTrip") {
    const auto check = []<class Params, class Reply>(const Method<Params, Reply>& method) {
        CAPTURE(method.info.name);
        const Json example = load(std::string(method.info.name) + ".example.json");
        CHECK(example["request"]["method"] == method.info.name);
        const Json& params = example["request"]["params"];
        CHECK(again<Params>(params) == params.dump());
        if constexpr (!std::is_same_v<Reply, OpenRpcDocument>) {
            const Json& result = example["reply"]["result"];
            CHECK(again<Reply>(result) == result.dump());
        }
    };
    std::apply([&](const auto&... method) { (check(method), ...); }, kMethodTypes);
}

TEST_CASE("Messages.OtherVariantsRoundTrip") {
    const char* until = GENERATE(R"({"until":{"time":2.5}})", R"({"until":{"duration":0.5,"timeout":3.0}})",
                                 R"({"until":{"step":40}})", R"({"until":{"steps":7},"wait":true,"pace":0.5})");
    const Json json = *parse_json(until);
    const Json written = *parse_json(again<SimRun>(until));
    CHECK(written["until"] == json["until"]);
    CHECK(written["wait"] == json.value("wait", false));

    CHECK(again<StreamOpen>(R"({"mode":"live","fields":["pressure"],"precision":"f8","rate":25.0})") ==
          R"({"mode":"live","fields":["pressure"],"precision":"f8","rate":25.0})");
    CHECK(again<ObjectsMove>(R"({"name":"ball","to":[1.0,2.0,3.0]})") == R"({"name":"ball","to":[1.0,2.0,3.0]})");
    CHECK(again<RecordStart>(
              R"({"file":"a.mcap","precision":"f8","every_steps":3,"compression":"none","overwrite":false})") ==
          R"({"file":"a.mcap","precision":"f8","every_steps":3,"compression":"none","overwrite":false})");
    CHECK(
        again<HelloReply>(
            R"({"program":"p","version":"v","protocol":1,"session":"s","events_endpoint":"ipc://e","frames_endpoint":"ipc://f","data_endpoint":"ipc://d","threads":1,"soft_message_limit":2,"hard_message_limit":3})") ==
        R"({"program":"p","version":"v","protocol":1,"session":"s","events_endpoint":"ipc://e","frames_endpoint":"ipc://f","data_endpoint":"ipc://d","threads":1,"soft_message_limit":2,"hard_message_limit":3})");
    CHECK(again<ParamsSet>(R"({"parameters":{"a":1.5,"b":true,"c":"text","d":[1.0,2.0,3.0]}})") ==
          R"({"parameters":{"a":1.5,"b":true,"c":"text","d":[1.0,2.0,3.0]}})");
}

TEST_CASE("Messages.ValuesReachTheirMembers") {
    const auto open = read<StreamOpen>(
        R"({"mode": "lossless", "fields": ["density"], "precision": "f8", "interval": 0.5, "window": 2,
            "on_stall": "fail", "stall_timeout": 7, "resume": "4", "acked": 9})");
    CHECK(open.mode == StreamMode::lossless);
    CHECK(open.fields == FieldSet{Field::density});
    CHECK(open.precision == Precision::f8);
    CHECK(open.interval == 0.5);
    CHECK_FALSE(open.every_steps.has_value());
    CHECK(open.window == 2);
    CHECK(open.on_stall == OnStall::fail);
    CHECK(open.stall_timeout == 7.0);
    CHECK(open.resume == "4");
    CHECK(open.acked == 9u);

    const auto load_preset =
        read<SceneLoad>(R"({"scene": "bowl", "parameters": {"viscosity": 2, "gravity": [0, -1]}})");
    CHECK(std::get<std::string>(load_preset.scene) == "bowl");
    CHECK(std::get<double>(load_preset.parameters.at("viscosity")) == 2.0);
    CHECK(std::get<Vec3>(load_preset.parameters.at("gravity")) == Vec3{0, -1, 0});

    const auto object = read<ObjectDesc>(
        R"({"name": "b", "role": "container", "shape": {"sphere": {"center": [1, 2, 3], "radius": 4}}})");
    CHECK(object.role == ObjectRole::container);
    CHECK(std::get<SphereDesc>(object.shape).center == Vec3{1, 2, 3});
    CHECK(std::get<SphereDesc>(object.shape).radius == 4.0);
}

TEST_CASE("Messages.AbsentMembersKeepTheirDefaults") {
    CHECK(read<SimStep>("{}").steps == 1);
    CHECK(read<StreamOpen>("{}").fields == kDefaultFields);
    CHECK(read<EventsSince>("{}").limit == 1000);
    CHECK_FALSE(read<SimRun>("{}").pace.has_value());
    CHECK(read<ObjectDesc>(R"({"name": "b", "shape": {"box": {"min": [0, 0], "max": [1, 1]}}})").role ==
          ObjectRole::obstacle);
}

TEST_CASE("Messages.NonFiniteNumbersTravelAsText") {
    FaultReport fault;
    fault.position = {std::nan(""), INFINITY, -INFINITY};
    const Json json = to_json(fault);
    CHECK(json["position"].dump() == R"(["NaN","Infinity","-Infinity"])");
    const auto back = from_json<FaultReport>(json, "fault");
    REQUIRE(back.ok());
    CHECK(std::isnan(back->position[0]));
    CHECK(back->position[1] == INFINITY);
    CHECK(back->position[2] == -INFINITY);

    // Never as null, and never in a request.
    SimRun run;
    run.pace = INFINITY;
    CHECK(to_json(run)["pace"] == "Infinity");
    CHECK_FALSE(from_json<SimRun>(to_json(run), "params").ok());
}

TEST_CASE("Messages.DoublesAreKeptToTheLastBit") {
    for (double x : {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 0.0271596660081}) {
        SimRun run;
        run.until.time = x;
        const auto text = to_json(run).dump();
        CHECK(read<SimRun>(text.c_str()).until.time == x);
    }
}

TEST_CASE("Messages.LargeIntegersAreKept") {
    CHECK(read<StreamAck>(R"({"stream": "1", "seq": 18446744073709551615})").seq == 18446744073709551615u);
    CHECK(again<StreamAck>(R"({"stream":"1","seq":18446744073709551615})") ==
          R"({"stream":"1","seq":18446744073709551615})");
}

TEST_CASE("Messages.RepliesPassOverMembersOfANewerPeer") {
    CHECK(read<Applied>(R"({"step": 4, "time": 0.5, "newer": {"x": 1}})").step == 4);
    const auto status = read<EventsSinceReply>(
        R"({"events": [{"seq": 1, "type": "t", "step": 0, "time": 0, "wall_clock": 0, "message": "", "newer": 1}],
            "last_seq": 1, "lost": 0})");
    CHECK(status.events.at(0).type == "t");
}

TEST_CASE("Messages.EventsAndObjectsAreTexts") {
    const Json example = load("event.example.json");
    const auto event = parse_event(example.dump());
    REQUIRE(event.ok());
    CHECK(event_text(*event) == example.dump());
    CHECK(std::get<std::int64_t>(event->data.at("count")) == 1);
    CHECK(std::get<double>(event->data.at("distance")) == 0.5);
    CHECK(std::get<bool>(event->data.at("by_scene")) == false);
    REQUIRE(event->objects.has_value());
    const std::string text = objects_text(*event->objects);
    CHECK(text == example["objects"].dump());
    const auto objects = parse_objects(text);
    REQUIRE(objects.ok());
    CHECK(objects->size() == 1);
    CHECK(parse_objects("[]")->empty());
    CHECK_FALSE(parse_objects("{}").ok());
}

TEST_CASE("Messages.EveryErrorRoundTrips") {
    for (const ErrorInfo& info : kErrors) {
        const Error error{info.code, "what happened", "params.x", "what to do"};
        const Json json = error_json(error);
        CHECK(json["code"] == info.rpc_code);
        CHECK(json["data"]["name"] == info.name);
        CHECK(json["data"]["retryable"] == info.retryable);
        const Error back = error_from_json(json);
        CHECK(back.code == info.code);
        CHECK(back.message == "what happened");
        CHECK(back.path == "params.x");
        CHECK(back.hint == "what to do");
    }
    CHECK(error_from_json(*parse_json(R"({"code": -32601, "message": "m"})")).code == ErrorCode::method_not_found);
    CHECK(error_from_json(*parse_json(R"({"code": -1, "message": "m", "data": 5})")).code == ErrorCode::internal_error);
    CHECK(error_from_json(*parse_json("[]")).code == ErrorCode::internal_error);
}
