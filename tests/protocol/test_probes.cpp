// Probes from outside: as part of a scene, added and removed, as ends of runs and triggers of events, in recordings.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <string>
#include <vector>

#include "proto/recording.h"
#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;

namespace {

Json probe(const char* name, const Json& kind) {
    return {{"name", name}, {"kind", kind}, {"every_steps", 1}};
}
const Json kFront = {{"front", {{"direction", {1, 0}}}}};
const Json kGauge = {{"level", {{"from", {0.05, 0}}, {"to", {0.05, 0.3}}}}};

// A block of water, 0.1 m x 0.1 m, that collapses in a tank; steps of 1 ms.
Json measured_pond() {
    Json scene = pond();
    scene["probes"] = Json::array({probe("tip", kFront), probe("gauge", kGauge)});
    scene["probes"][1].erase("every_steps");
    scene["probes"][1]["interval"] = 0.005;
    return scene;
}

struct Loaded {
    explicit Loaded(const Json& scene) { client.call("scene.load", {{"scene", scene}}); }
    Json rows(const char* name) { return client.call("probes.get", {{"name", name}})["probes"][0]["rows"]; }
    std::vector<std::string> event_types() {
        std::vector<std::string> types;
        const Json events = client.call("events.since", {{"seq", 0}})["events"];
        for (const Json& event : events) types.push_back(event["type"]);
        return types;
    }
    std::ptrdiff_t count(const char* type) {
        const auto types = event_types();
        return std::count(types.begin(), types.end(), type);
    }

    TestServer server;
    Client client{server->control_endpoint()};
};

}  // namespace

TEST_CASE("Probes.OfASceneAreSampledFromItsStart") {
    Loaded loaded(measured_pond());
    Json list = loaded.client.call("probes.list")["probes"];
    REQUIRE(list.size() == 2);
    CHECK(list[0]["probe"]["name"] == "tip");
    CHECK(list[0]["samples"] == 1);
    // The edge of the last column of particles; the surface of a block that stands 0.1 m high: half a spacing.
    CHECK(list[0]["latest"][1].get<double>() == Approx(0.1));
    CHECK(list[1]["latest"][1].get<double>() == Approx(0.1).margin(0.005));

    loaded.client.call("sim.step", {{"steps", 10}});
    const Json tip = loaded.rows("tip");
    REQUIRE(tip.size() == 11);
    CHECK(tip[10][0].get<double>() == Approx(0.01));
    CHECK(loaded.rows("gauge").size() == 3);
    CHECK(loaded.client.call("probes.get", {{"since", 0.0045}, {"limit", 2}})["probes"][0]["rows"].size() == 2);

    // A reset begins anew.
    loaded.client.call("sim.reset");
    CHECK(loaded.rows("tip") == Json::array({tip[0]}));
    // A scene without probes has none.
    loaded.client.call("scene.load", {{"scene", pond()}});
    CHECK(loaded.client.call("probes.list")["probes"].empty());
    CHECK(loaded.client.ask("probes.get", {{"name", "tip"}}).error_name() == "probe_not_found");
}

TEST_CASE("Probes.AndFramesAreInThePlanOnlyWhileSomebodyWantsThem") {
    Loaded loaded(pond());
    const auto stage = [&](const char* name) {
        const Json plan = loaded.client.call("sim.status")["plan"];
        return *std::find_if(plan.begin(), plan.end(), [&](const Json& one) { return one["stage"] == name; });
    };
    loaded.client.call("sim.step", {{"steps", 3}});
    for (const char* name : {"probes", "frames"}) {
        INFO(name);
        CHECK_FALSE(stage(name)["active"].get<bool>());
        CHECK(stage(name)["seconds"] == 0.0);
        CHECK_FALSE(stage(name)["reason"].get<std::string>().empty());
    }
    loaded.client.call("probes.add", {{"probe", probe("gauge", kGauge)}});
    loaded.client.call("record.start", {{"file", "plan.mcap"}, {"every_steps", 1}});
    loaded.client.call("sim.step", {{"steps", 3}});
    for (const char* name : {"probes", "frames"}) {
        INFO(name);
        CHECK(stage(name)["active"].get<bool>());
        CHECK(stage(name)["seconds"].get<double>() > 0.0);
    }
    CHECK(loaded.client.call("sim.status")["strategy"].get<std::string>().find("precision") != std::string::npos);
}

TEST_CASE("Probes.ComeAndGoBetweenSteps") {
    Loaded loaded(pond());
    loaded.client.call("sim.step", {{"steps", 5}});
    CHECK(loaded.client.call("probes.add", {{"probe", probe("tip", kFront)}})["step"] == 5);
    CHECK(loaded.rows("tip").size() == 1);
    loaded.client.call("sim.step", {{"steps", 5}});
    CHECK(loaded.rows("tip").size() == 6);

    CHECK(loaded.client.ask("probes.add", {{"probe", probe("tip", kFront)}}).error_name() == "probe_exists");
    const Answer force = loaded.client.ask("probes.add", {{"probe", probe("f", {{"force", {{"object", "tank"}}}})}});
    CHECK(force.error_name() == "invalid_params");  // the thesis's model has no forces on walls
    CHECK(force.path() == "params.probe.kind");
    const Answer object = loaded.client.ask("probes.add", {{"probe", probe("f", {{"force", {{"object", "tnak"}}}})}});
    CHECK(object.error_name() == "object_not_found");
    CHECK(object.hint().find("tank") != std::string::npos);
    const Answer kind = loaded.client.ask("probes.add", {{"probe", probe("f", {{"levle", Json::object()}})}});
    CHECK(kind.error_name() == "invalid_params");

    CHECK(loaded.client.ask("probes.remove", {{"name", "tipp"}}).error_name() == "probe_not_found");
    loaded.client.call("probes.remove", {{"name", "tip"}});
    CHECK(loaded.client.call("probes.list")["probes"].empty());
    CHECK(loaded.count("probe.added") == 1);
    CHECK(loaded.count("probe.removed") == 1);
}

TEST_CASE("Probes.ARunEndsAtAProbesValue") {
    Loaded loaded(measured_pond());
    const Json until = {{"until", {{"probe", {{"probe", "tip"}, {"above", 0.105}}}}}, {"wait", true}};
    const Json job = loaded.client.call("sim.run", until);
    CHECK(job["state"] == "finished");
    CHECK(job["reason"].get<std::string>().find("probe tip is 0.1") == 0);
    const Json rows = loaded.rows("tip");
    CHECK(rows.back()[1].get<double>() > 0.105);
    CHECK(rows[rows.size() - 2][1].get<double>() <= 0.105);
    // What holds already is reached.
    CHECK(loaded.client.call("sim.run", until)["steps"] == 0);

    Json unknown = until;
    unknown["until"]["probe"]["probe"] = "tap";
    const Answer refused = loaded.client.ask("sim.run", unknown);
    CHECK(refused.error_name() == "probe_not_found");
    CHECK(refused.path() == "params.until.probe.probe");
    CHECK(refused.hint().find("tip") != std::string::npos);
}

TEST_CASE("Probes.ARunKeepsTheProbeItWaitsFor") {
    Loaded loaded(measured_pond());
    loaded.client.call("sim.run", {{"until", {{"probe", {{"probe", "tip"}, {"above", 100}}}}}, {"pace", 1e-6}});
    CHECK(loaded.client.ask("probes.remove", {{"name", "tip"}}).error_name() == "wrong_state");
    loaded.client.call("probes.remove", {{"name", "gauge"}});
    loaded.client.call("sim.cancel");
    loaded.client.call("probes.remove", {{"name", "tip"}});
}

TEST_CASE("Probes.AnEventOfTheSceneFiresAtAProbesValue") {
    Json scene = measured_pond();
    scene["events"] =
        Json::array({{{"probe", {{"probe", "tip"}, {"above", 0.105}}}, {"action", {{"pause", Json::object()}}}}});
    Loaded loaded(scene);
    loaded.client.call("sim.run", {{"until", {{"steps", 1000}}}});
    REQUIRE(eventually([&] { return loaded.client.call("sim.status")["state"] == "idle"; }));
    CHECK(loaded.client.call("sim.status")["job"]["state"] == "paused");
    CHECK(loaded.rows("tip").back()[1].get<double>() > 0.105);
    CHECK(loaded.count("scene_event.fired") == 1);
}

TEST_CASE("Probes.ASceneWithABadProbeIsRefusedWithItsPath") {
    TestServer server;
    Client client(server->control_endpoint());
    Json scene = measured_pond();
    scene["probes"][1]["kind"] = {{"energies", Json::object()}};  // not of the thesis's model
    const Answer energies = client.ask("scene.load", {{"scene", scene}});
    CHECK(energies.error_name() == "scene_invalid");
    CHECK(energies.path() == "scene.probes[1].kind");
    CHECK(client.call("sim.status")["state"] == "empty");

    scene = measured_pond();
    scene["events"] =
        Json::array({{{"probe", {{"probe", "tap"}, {"above", 1}}}, {"action", {{"pause", Json::object()}}}}});
    const Answer event = client.ask("scene.load", {{"scene", scene}});
    CHECK(event.error_name() == "scene_invalid");
    CHECK(event.path() == "scene.events[0].probe.probe");
}

TEST_CASE("Probes.ARecordingHoldsEverySample") {
    Loaded loaded(measured_pond());
    loaded.client.call("record.start", {{"file", "run.mcap"}});
    loaded.client.call("sim.step", {{"steps", 10}});
    loaded.client.call("probes.remove", {{"name", "gauge"}});
    loaded.client.call("sim.step", {{"steps", 10}});
    const Json tip = loaded.rows("tip");
    // Another scene ends it: what was sampled up to there is in the file.
    loaded.client.call("scene.load", {{"scene", measured_pond()}});
    loaded.client.call("sim.step", {{"steps", 3}});
    REQUIRE(eventually([&] { return loaded.client.call("sim.status")["recordings"] == 0; }));

    const auto reader = proto::RecordingReader::open(loaded.server.data_folder() / "run.mcap");
    REQUIRE(reader.ok());
    std::map<std::string, std::vector<std::vector<double>>> rows;
    REQUIRE((*reader)->read_probes([&](const proto::ProbeSamples& instant) {
        for (const proto::ProbeSample& sample : instant.samples) {
            REQUIRE(sample.columns.size() == 1);
            CHECK(sample.columns[0].unit == "m");
            rows[sample.probe].push_back({instant.time, sample.values[0].value()});
        }
    }));
    CHECK(Json(rows["tip"]) == tip);
    CHECK(rows["tip"].size() == 21);
    CHECK(rows["gauge"].size() == 3);
}

TEST_CASE("Probes.InspectExplainsAParticleOrSaysWhyNot") {
    Loaded loaded(pond());
    const Answer unknown = loaded.client.ask("sim.inspect", {{"id", 100}});
    CHECK(unknown.error_name() == "particle_not_found");
    CHECK(unknown.hint().find("0 to 99") != std::string::npos);
    const Answer thesis = loaded.client.ask("sim.inspect", {{"id", 99}});
    CHECK(thesis.error_name() == "invalid_params");
    CHECK(thesis.hint().find("wcsph") != std::string::npos);
}
