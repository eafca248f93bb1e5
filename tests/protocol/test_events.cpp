// events.since and the events socket.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;

TEST_CASE("Events.AreNumberedWithoutGapsFromTheStart") {
    TestServer server;
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});
    client.call("sim.step", {{"steps", 3}});
    const Json reply = client.call("events.since");
    std::uint64_t next = 1;
    std::vector<std::string> types;
    for (const Json& event : reply["events"]) {
        CHECK(event["seq"] == next++);
        types.push_back(event["type"]);
    }
    CHECK(types == std::vector<std::string>{"server.started", "scene.loaded", "job.started", "job.ended"});
    CHECK(reply["last_seq"] == next - 1);
    CHECK(reply["lost"] == 0);

    // The rest of them, one at a time.
    const Json second = client.call("events.since", {{"seq", 1}, {"limit", 1}});
    REQUIRE(second["events"].size() == 1);
    CHECK(second["events"][0]["type"] == "scene.loaded");
    CHECK(second["last_seq"] == 2);
}

TEST_CASE("Events.ALongPollIsAnsweredByWhatItWaitsFor") {
    TestServer server;
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});
    const std::uint64_t last = client.call("events.since")["last_seq"];
    const std::int64_t waiting =
        client.post("events.since", {{"seq", last}, {"timeout", 60}, {"types", {"object.removed"}}});
    client.call("objects.move", {{"name", "tank"}, {"by", {0, 0}}});
    CHECK_FALSE(client.has_arrived(waiting));
    client.call("objects.remove", {{"name", "tank"}});
    const Json reply = client.await(waiting).result();
    REQUIRE(reply["events"].size() == 1);
    CHECK(reply["events"][0]["type"] == "object.removed");
    CHECK(reply["events"][0]["objects"].empty());
}

TEST_CASE("Events.ALongPollEndsEmptyAtItsTimeout") {
    TestServer server;
    Client client(server->control_endpoint());
    const std::uint64_t last = client.call("events.since")["last_seq"];
    const Json reply = client.call("events.since", {{"seq", last}, {"timeout", 0.05}});
    CHECK(reply["events"].empty());
    CHECK(reply["last_seq"] == last);
    CHECK(client.ask("events.since", {{"timeout", 61}}).error_name() == "invalid_params");
    CHECK(client.ask("events.since", {{"timeout", -1}}).error_name() == "invalid_params");
}

TEST_CASE("Events.TheSocketCarriesTheSameEvents") {
    TestServer server;
    Client client(server->control_endpoint());
    Subscriber events(server->events_endpoint(), "object");
    client.call("scene.load", {{"scene", pond()}});
    // A subscription takes its time to arrive: events are made until one comes through.
    std::optional<std::string> message;
    REQUIRE(eventually([&] {
        client.call("objects.move", {{"name", "tank"}, {"by", {0, 0}}});
        return (message = events.try_receive(Seconds(0.01))).has_value();
    }));
    REQUIRE(message->size() > proto::kTopicBytes);
    const Json event = Json::parse(message->substr(proto::kTopicBytes));
    const std::uint64_t seq = event["seq"];
    const Json same = client.call("events.since", {{"seq", seq - 1}, {"limit", 1}})["events"][0];
    CHECK(event == same);
    CHECK(message->substr(0, 7) == std::string("object\0", 7));
}

TEST_CASE("Events.StatusIsSentOnlyOnRequest") {
    TestServer server;
    Subscriber status(server->events_endpoint(), "status");
    const std::string message = status.receive("status");
    CHECK(Json::parse(message.substr(proto::kTopicBytes))["state"] == "empty");
}

TEST_CASE("Events.AnActionOfTheSceneThatIsRefusedIsTold") {
    TestServer server;
    Client client(server->control_endpoint());
    Json scene = pond();
    const auto remove_tank_at = [](int step) -> Json {
        return {{"step", step}, {"action", {{"remove_object", {{"name", "tank"}}}}}};
    };
    scene["events"] = Json::array({remove_tank_at(1), remove_tank_at(2)});
    client.call("scene.load", {{"scene", scene}});
    client.call("sim.step", {{"steps", 3}});
    std::vector<std::string> types;
    const Json events = client.call("events.since", {{"seq", 0}})["events"];
    for (const Json& event : events) {
        types.push_back(event["type"]);
        if (types.back() != "scene_event.failed") continue;
        CHECK(event["data"]["event"] == 1);
        CHECK(event["data"]["error"] == "object_not_found");
        CHECK(event["message"].get<std::string>().find("tank") != std::string::npos);
    }
    CHECK(std::count(types.begin(), types.end(), "object.removed") == 1);
    CHECK(std::count(types.begin(), types.end(), "scene_event.failed") == 1);
    CHECK(client.call("sim.status")["step"] == 3);  // the run went on
}
