// Loading, stepping, running, pausing, cancelling, and what stays possible meanwhile.
#include <catch2/catch.hpp>
#include <string>
#include <utility>

#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;

namespace {

// A server with a scene, and a client.
struct Loaded {
    explicit Loaded(const Json& scene) { client.call("scene.load", {{"scene", scene}}); }
    Json run(const Json& until) { return client.call("sim.run", {{"until", until}, {"wait", true}}); }

    TestServer server;
    Client client{server->control_endpoint()};
};

}  // namespace

TEST_CASE("Runs.LoadTellsWhatWasBuilt") {
    Loaded loaded(pond());
    const Json status = loaded.client.call("sim.status");
    CHECK(status["state"] == "idle");
    CHECK(status["scene"] == "pond");
    CHECK(status["particles"] == 100);
    CHECK(status["step"] == 0);
    CHECK(loaded.client.call("scene.get")["name"] == "pond");

    const Json reply = loaded.client.call("scene.load", {{"scene", "dam_break"}, {"parameters", {{"viscosity", 2.5}}}});
    CHECK(reply["particles"] == 3000);
    CHECK(reply["objects"] == Json::array({"tank", "panel"}));
    CHECK(loaded.client.call("params.get", {{"names", {"viscosity"}}})["parameters"][0]["value"] == 2.5);
    CHECK(loaded.client.call("scene.get")["parameters"]["viscosity"] == 2.5);
}

TEST_CASE("Runs.EachListedSceneLoadsWithAsManyParticlesAsListed") {
    TestServer server;
    Client client(server->control_endpoint());
    const Json scenes = client.call("scene.list")["scenes"];
    REQUIRE_FALSE(scenes.empty());
    for (const Json& scene : scenes) {
        INFO(scene.dump());
        CHECK(client.call("scene.load", {{"scene", scene["name"]}})["particles"] == scene["particles"]);
    }
}

TEST_CASE("Runs.AScenesFaultIsToldWithItsPath") {
    TestServer server;
    Client client(server->control_endpoint());
    const Answer unknown = client.ask("scene.load", {{"scene", "dam_braek"}});
    CHECK(unknown.error_name() == "scene_not_found");
    CHECK(unknown.hint().find("dam_break") != std::string::npos);

    Json outside = pond();
    outside["fluids"][0]["shape"]["box"]["max"] = {0.5, 0.5};
    const Answer refused = client.ask("scene.load", {{"scene", outside}});
    CHECK(refused.error_name() == "scene_invalid");
    CHECK(refused.path().find("fluids[0]") != std::string::npos);

    const Answer parameter = client.ask("scene.load", {{"scene", pond()}, {"parameters", {{"viscosty", 1}}}});
    CHECK(parameter.error_name() == "parameter_not_found");
    CHECK(client.call("sim.status")["state"] == "empty");
}

TEST_CASE("Runs.EndWhereTheyWereToldTo") {
    Loaded loaded(pond());
    // Steps of 1 ms.
    const Json steps = loaded.run({{"steps", 5}});
    CHECK(steps["state"] == "finished");
    CHECK(steps["step"] == 5);
    CHECK(steps["steps"] == 5);
    CHECK(loaded.run({{"step", 20}})["steps"] == 15);
    CHECK(loaded.run({{"time", 0.03}})["step"] == 30);
    CHECK(loaded.run({{"duration", 0.005}})["step"] == 35);
    CHECK(loaded.client.call("sim.step")["step"] == 36);
    CHECK(loaded.client.call("sim.step", {{"steps", 4}})["step"] == 40);
    // A target that is past is reached.
    CHECK(loaded.run({{"step", 10}})["steps"] == 0);

    const Json late = loaded.run({{"time", 1000}, {"timeout", 0.01}});
    CHECK(late["state"] == "timed_out");
    CHECK(late["step"] == 50);
}

TEST_CASE("Runs.UntilAtRestEndsAtRestOrAtItsTimeout") {
    Loaded loaded(calm_pond());
    const Json rest = loaded.run({{"at_rest", true}});
    CHECK(rest["state"] == "finished");
    CHECK(rest["reason"] == "at rest");
    CHECK(rest["time"].get<double>() >= 0.02 * (1 - 1e-9));

    // Falling freely it never rests.
    loaded.client.call("scene.load", {{"scene", pond()}});
    const Json late = loaded.run({{"at_rest", true}, {"timeout", 0.01}});
    CHECK(late["state"] == "timed_out");
}

TEST_CASE("Runs.APaceHoldsTheRunBack") {
    Loaded loaded(pond());
    const Json job = loaded.client.call("sim.run", {{"until", {{"steps", 50}}}, {"pace", 1}, {"wait", true}});
    // 50 steps of 1 ms at one simulated second per wall second.
    CHECK(job["wall_s"].get<double>() >= 0.05 * (1 - 1e-9));
}

TEST_CASE("Runs.WithoutWaitTheJobIsAskedFor") {
    Loaded loaded(pond());
    const Json started = loaded.client.call("sim.run", {{"until", {{"steps", 10}}}});
    CHECK(started["state"] == "running");
    const Json ended = loaded.client.call("job.wait", {{"job", started["job"]}, {"timeout", 60}});
    CHECK(ended["state"] == "finished");
    CHECK(ended["step"] == 10);
    CHECK(loaded.client.call("sim.status")["job"]["job"] == started["job"]);
    CHECK(loaded.client.ask("job.wait", {{"job", 999}}).error_name() == "job_not_found");
}

TEST_CASE("Runs.AJobThatGoesOnTimesTheWaitOut") {
    Loaded loaded(pond());
    const Json started = loaded.client.call("sim.run", {{"pace", 1e-6}});
    CHECK(loaded.client.ask("job.wait", {{"job", started["job"]}, {"timeout", 0.05}}).error_name() == "timed_out");
    CHECK(loaded.client.ask("job.wait", {{"job", started["job"]}, {"timeout", 0}}).error_name() == "timed_out");
    const std::int64_t waiting = loaded.client.post("job.wait", {{"job", started["job"]}});
    loaded.client.call("sim.cancel");
    CHECK(loaded.client.await(waiting).result()["state"] == "cancelled");
}

TEST_CASE("Runs.PausedAJobStaysAndGoesOn") {
    Loaded loaded(pond());
    const Json started = loaded.client.call("sim.run", {{"until", {{"step", 100}}}, {"pace", 1e-6}});
    loaded.client.call("sim.pause");
    const Json paused = loaded.client.call("sim.status");
    CHECK(paused["state"] == "idle");
    CHECK(paused["job"]["state"] == "paused");
    CHECK(loaded.client.ask("sim.run").error_name() == "wrong_state");
    // Single steps between a pause and a resume.
    loaded.client.call("sim.step", {{"steps", 3}});
    const Json resumed = loaded.client.call("sim.resume");
    CHECK(resumed["job"] == started["job"]);
    CHECK(resumed["state"] == "running");
    loaded.client.call("sim.cancel");
    CHECK(loaded.client.call("job.wait", {{"job", started["job"]}})["state"] == "cancelled");
}

TEST_CASE("Runs.StatusPauseAndCancelAreAnsweredWhileALargeSceneSteps") {
    Loaded loaded(deep_tank());
    Client runner(loaded.server->control_endpoint());
    const std::int64_t run = runner.post("sim.run", {{"wait", true}});
    REQUIRE(eventually([&] { return loaded.client.call("sim.status")["state"] == "running"; }));

    // Two answers that show the same step, then one that shows another: status waits for no step.
    std::int64_t step = -1;
    REQUIRE(eventually([&] {
        const Json status = loaded.client.call("sim.status");
        return std::exchange(step, status["step"].get<std::int64_t>()) == status["step"] &&
               status["state"] == "running";
    }));
    REQUIRE(eventually([&] { return loaded.client.call("sim.status")["step"] > step; }));
    CHECK_FALSE(runner.has_arrived(run));

    // A step takes longer than an answer may: unless the step is nearly done (then try again), the answer comes before
    // its end, and names the step that is the last.
    Json paused;
    REQUIRE(eventually([&] {
        loaded.client.call("sim.resume");
        paused = loaded.client.call("sim.pause");
        return paused.value("pending", false);
    }));
    REQUIRE(eventually([&] { return loaded.client.call("sim.status")["state"] == "idle"; }));
    CHECK(loaded.client.call("sim.status")["step"] == paused["step"]);
    CHECK_FALSE(runner.has_arrived(run));
    loaded.client.call("sim.resume");
    REQUIRE(eventually([&] { return loaded.client.call("sim.status")["step"] > paused["step"]; }));
    const Json cancelled = loaded.client.call("sim.cancel");
    CHECK(runner.await(run).result()["state"] == "cancelled");
    CHECK(loaded.client.call("sim.status")["step"] == cancelled["step"]);
}

TEST_CASE("Runs.ALoadIsWatchedAndCancelled") {
    Loaded loaded(pond());
    loaded.client.call("sim.step", {{"steps", 2}});
    const std::int64_t load = loaded.client.post("scene.load", {{"scene", lake()}});
    REQUIRE(eventually([&] { return loaded.client.call("sim.status")["state"] == "loading"; }));
    // The scene before it is still there.
    CHECK(loaded.client.call("scene.get")["name"] == "pond");
    CHECK_FALSE(loaded.client.has_arrived(load));
    loaded.client.call("sim.cancel");
    CHECK(loaded.client.await(load).error_name() == "cancelled");
    const Json status = loaded.client.call("sim.status");
    CHECK(status["state"] == "idle");
    CHECK(status["scene"] == "pond");
    CHECK(status["step"] == 2);
}

TEST_CASE("Runs.ResetStartsTheSameRunAnew") {
    Loaded loaded(pond());
    loaded.client.call("params.set", {{"parameters", {{"viscosity", 9.0}}}});
    loaded.client.call("objects.remove", {{"name", "tank"}});
    loaded.run({{"steps", 5}});
    const Json reset = loaded.client.call("sim.reset");
    CHECK(reset["step"] == 0);
    CHECK(reset["objects"] == Json::array({"tank"}));
    CHECK(loaded.client.call("params.get", {{"names", {"viscosity"}}})["parameters"][0]["value"] != 9.0);
}

TEST_CASE("Runs.AFaultIsAReportNotACrash") {
    Loaded loaded(doomed_drop());
    const Json job = loaded.run({{"steps", 100}});
    CHECK(job["state"] == "faulted");
    const Json status = loaded.client.call("sim.status");
    REQUIRE(status["state"] == "faulted");
    CHECK(status["fault"]["criterion"] == "left_domain");
    CHECK_FALSE(status["fault"]["remedy"].get<std::string>().empty());
    CHECK(status["fault"]["position"][1].get<double>() < -0.05);

    // The event says the same: particle, step, time and remedy.
    const Json events = loaded.client.call("events.since", {{"types", {"sim.faulted"}}})["events"];
    REQUIRE(events.size() == 1);
    CHECK(events[0]["data"]["particle"] == status["fault"]["particle"]);
    CHECK(events[0]["data"]["remedy"] == status["fault"]["remedy"]);
    CHECK(events[0]["step"] == status["fault"]["step"]);
    CHECK(events[0]["time"] == status["fault"]["time"]);
    CHECK(loaded.client.call("sim.reset")["state"] == "idle");
}
