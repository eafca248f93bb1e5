// Parameters and objects that change while the run goes on, scene events, and the state hash.
#include <catch2/catch.hpp>
#include <string>

#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;

namespace {

struct Loaded {
    explicit Loaded(const Json& scene) { client.call("scene.load", {{"scene", scene}}); }
    std::string hash() { return client.call("sim.status", {{"hash", true}})["state_hash"]["value"]; }

    TestServer server;
    Client client{server->control_endpoint()};
};

const Json kThicker{{"parameters", {{"viscosity", 50.0}}}};

Json ball() {
    return {{"object", {{"name", "ball"}, {"shape", {{"sphere", {{"center", {0.2, 0.1}}, {"radius", 0.05}}}}}}}};
}

}  // namespace

TEST_CASE("Mutations.TheSameCommandsGiveTheSameHash") {
    Loaded one(pond()), two(pond());
    const std::string start = one.hash();
    CHECK(two.hash() == start);
    for (Loaded* server : {&one, &two}) {
        server->client.call("sim.step", {{"steps", 10}});
        server->client.call("params.set", kThicker);
        server->client.call("sim.step", {{"steps", 10}});
    }
    const std::string end = one.hash();
    CHECK(end != start);
    CHECK(two.hash() == end);

    // And not the same without the change.
    one.client.call("sim.reset");
    CHECK(one.hash() == start);
    one.client.call("sim.step", {{"steps", 20}});
    CHECK(one.hash() != end);
}

TEST_CASE("Mutations.AParameterIsSetBeforeTheStepThatWasNamed") {
    Loaded planned(pond()), by_hand(pond());
    Json later = kThicker;
    later["at_step"] = 10;
    const std::int64_t change = planned.client.post("params.set", later);
    const std::int64_t steps = planned.client.post("sim.step", {{"steps", 20}});
    CHECK(planned.client.await(change).result()["step"] == 10);
    CHECK(planned.client.await(steps).result()["step"] == 20);

    by_hand.client.call("sim.step", {{"steps", 10}});
    by_hand.client.call("params.set", kThicker);
    by_hand.client.call("sim.step", {{"steps", 10}});
    CHECK(planned.hash() == by_hand.hash());

    const Answer past = planned.client.ask("params.set", later);
    CHECK(past.error_name() == "invalid_params");
    CHECK(past.path() == "params.at_step");
}

TEST_CASE("Mutations.AParameterIsSetWhileTheRunGoesOn") {
    Loaded loaded(deep_tank());
    loaded.client.call("sim.run");
    const Json reply = loaded.client.call("params.set", kThicker);
    CHECK(reply["previous"].contains("viscosity"));
    CHECK(loaded.client.call("sim.status")["state"] == "running");
    CHECK(loaded.client.call("params.get", {{"names", {"viscosity"}}})["parameters"][0]["value"] == 50.0);
    loaded.client.call("sim.cancel");
}

TEST_CASE("Mutations.ParametersAreSetAllOrNone") {
    Loaded loaded(pond());
    const Json before = loaded.client.call("params.get");
    const Answer unknown = loaded.client.ask("params.set", {{"parameters", {{"viscosity", 1}, {"viscosty", 1}}}});
    CHECK(unknown.error_name() == "parameter_not_found");
    CHECK(unknown.hint().find("viscosity") != std::string::npos);
    const Answer range = loaded.client.ask("params.set", {{"parameters", {{"viscosity", 1}, {"time_step", -1}}}});
    CHECK(range.error_name() == "invalid_params");
    CHECK(range.path() == "params.parameters.time_step");
    CHECK(loaded.client.ask("params.set", {{"parameters", {{"viscosity", "thick"}}}}).error_name() == "invalid_params");
    CHECK(loaded.client.call("params.get") == before);
    CHECK(loaded.client.ask("params.get", {{"names", {"viscosty"}}}).error_name() == "parameter_not_found");
}

TEST_CASE("Mutations.ObjectsComeMoveAndGoWhileTheRunGoesOn") {
    Loaded loaded(pond());
    loaded.client.call("sim.run", {{"pace", 1e-6}});
    loaded.client.call("objects.add", ball());
    CHECK(loaded.client.ask("objects.add", ball()).error_name() == "object_exists");
    loaded.client.call("objects.move", {{"name", "ball"}, {"by", {0.01, 0}}});
    Json objects = loaded.client.call("objects.list")["objects"];
    REQUIRE(objects.size() == 2);
    CHECK(objects[1]["shape"]["sphere"]["center"][0].get<double>() == Approx(0.21));
    loaded.client.call("objects.move", {{"name", "ball"}, {"to", {0.2, 0.2}}});
    objects = loaded.client.call("objects.list")["objects"];
    CHECK(objects[1]["shape"]["sphere"]["center"][1].get<double>() == Approx(0.2));
    loaded.client.call("objects.remove", {{"name", "ball"}});
    CHECK(loaded.client.call("objects.list")["objects"].size() == 1);

    const Answer gone = loaded.client.ask("objects.remove", {{"name", "tnk"}});
    CHECK(gone.error_name() == "object_not_found");
    CHECK(gone.hint() == "did you mean \"tank\"?");
    CHECK(loaded.client.ask("objects.move", {{"name", "tank"}}).error_name() == "invalid_params");
    CHECK(loaded.client.call("sim.status")["state"] == "running");
}

TEST_CASE("Mutations.SceneEventsFireAtTheirStepAndTime") {
    Json scene = pond();
    scene["events"] = Json::parse(R"([
        {"step": 5, "action": {"set_parameters": {"parameters": {"viscosity": 2}}}},
        {"time": 0.01, "action": {"remove_object": {"name": "tank"}}},
        {"step": 15, "action": {"pause": {}}}])");
    Loaded loaded(scene);
    const Json started = loaded.client.call("sim.run", {{"until", {{"step", 20}}}});
    Json seen = Json::object();  // event number -> step
    std::uint64_t last = 0;
    bool is_paused = false;
    while (!is_paused) {
        const Json reply = loaded.client.call("events.since", {{"seq", last}, {"timeout", 30}});
        REQUIRE_FALSE(reply["events"].empty());
        last = reply["last_seq"];
        for (const Json& event : reply["events"]) {
            if (event["type"] == "scene_event.fired")
                seen[std::to_string(event["data"]["event"].get<int>())] = event["step"];
            is_paused = is_paused || event["type"] == "job.paused";
        }
    }
    CHECK(seen == Json::parse(R"({"0": 5, "1": 10, "2": 15})"));
    CHECK(loaded.client.call("objects.list")["objects"].empty());
    CHECK(loaded.client.call("sim.status")["step"] == 15);
    loaded.client.call("sim.resume");
    CHECK(loaded.client.call("job.wait", {{"job", started["job"]}})["step"] == 20);
}

TEST_CASE("Mutations.ASceneEventWaitsForRest") {
    Json scene = calm_pond();
    scene["events"] = Json::parse(R"([{"at_rest": true, "action": {"remove_object": {"name": "tank"}}}])");
    Loaded loaded(scene);
    const std::int64_t waiting = loaded.client.post(
        "events.since", {{"seq", 1000000}, {"timeout", 0}});  // beyond what there is: answered at once, empty
    CHECK(loaded.client.await(waiting).result()["events"].empty());
    loaded.client.call("sim.step", {{"steps", 40}});
    const Json fired = loaded.client.call("events.since", {{"types", {"scene_event.fired", "object.removed"}}});
    REQUIRE(fired["events"].size() == 2);
    // At rest after 20 steps of 1 ms.
    CHECK(fired["events"][0]["step"].get<int>() >= 20);
    CHECK(fired["events"][1]["objects"].empty());
}
