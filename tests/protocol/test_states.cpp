// The state table, method by method, in every state of a live server.
#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "server/state_table.h"
#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;
using proto::SimState;

namespace {

// Params with which a method succeeds where it is allowed. `turn` keeps file names apart.
Json params_for(std::string_view method, int turn) {
    if (method == "scene.load") return {{"scene", pond()}};
    if (method == "sim.step") return {{"steps", 2}};
    if (method == "sim.run") return {{"until", {{"steps", 2}}}};
    if (method == "params.set") return {{"parameters", {{"viscosity", 0.5}}}};
    if (method == "objects.add")
        return {{"object", {{"name", "ball"}, {"shape", {{"sphere", {{"center", {0.8, 0.8}}, {"radius", 0.05}}}}}}}};
    if (method == "objects.move") return {{"name", "tank"}, {"by", {0, 0}}};
    if (method == "objects.remove") return {{"name", "tank"}};
    if (method == "probes.add") return {{"probe", {{"name", "tip"}, {"kind", {{"front", Json::object()}}}}}};
    if (method == "probes.remove") return {{"name", "gauge"}};
    if (method == "sim.inspect") return {{"id", 0}};
    if (method == "record.start") return {{"file", "states" + std::to_string(turn) + ".mcap"}};
    return Json::object();
}

bool is_allowed(const server::StateRule& rule, SimState state) {
    switch (state) {
        case SimState::empty:
            return rule.empty;
        case SimState::loading:
            return rule.loading;
        case SimState::idle:
            return rule.idle;
        case SimState::running:
            return rule.running;
        case SimState::faulted:
            return rule.faulted;
    }
    return false;
}

std::string state_of(Client& client) {
    return client.call("sim.status").at("state");
}

Json measured_pond() {
    Json scene = pond();
    scene["probes"] = Json::array({{{"name", "gauge"}, {"kind", {{"front", Json::object()}}}}});
    return scene;
}

// Brings a server with any past into the state.
void reach(Client& client, SimState state) {
    client.call("sim.cancel");
    if (state == SimState::empty) return;
    // A load that was cancelled answers a little later.
    REQUIRE(eventually([&] { return state_of(client) != "loading"; }));
    client.call("scene.load", {{"scene", state == SimState::faulted ? doomed_drop() : measured_pond()}});
    if (state == SimState::running) client.call("sim.run", {{"pace", 1e-6}});
    if (state == SimState::faulted) client.call("sim.step", {{"steps", 100}});
    if (state == SimState::loading) {
        client.post("scene.load", {{"scene", lake()}});
        REQUIRE(eventually([&] { return state_of(client) == "loading"; }));
    }
    REQUIRE(state_of(client) == server::state_name(state));
}

void check_answer(const Answer& answer, const server::StateRule& rule, SimState state) {
    INFO(rule.method << " while " << server::state_name(state) << ": " << answer.message.dump().substr(0, 500));
    if (is_allowed(rule, state)) {
        // The thesis's model cannot explain a particle: a refusal that is not the state's.
        CHECK((answer.ok() || (rule.method == "sim.inspect" && answer.error_name() == "invalid_params")));
        return;
    }
    CHECK(answer.error_name() == (state == SimState::loading ? "busy" : "wrong_state"));
    CHECK_FALSE(answer.hint().empty());
    if (state != SimState::loading)
        CHECK(answer.message["error"]["message"].get<std::string>().find(server::state_name(state)) !=
              std::string::npos);
}

}  // namespace

TEST_CASE("States.EveryMethodInEveryStateAnswersAsTheTableSays") {
    TestServer server;
    Client client(server->control_endpoint());
    int turn = 0;
    for (SimState state : {SimState::idle, SimState::running, SimState::faulted}) {
        for (const server::StateRule& rule : server::kStateTable) {
            reach(client, state);
            check_answer(client.ask(rule.method, params_for(rule.method, ++turn)), rule, state);
        }
    }
}

TEST_CASE("States.AnEmptyServerAnswersAsTheTableSays") {
    TestServer server;
    Client client(server->control_endpoint());
    // scene.load comes first in the table and last here: it ends the state.
    for (auto rule = server::kStateTable.rbegin(); rule != server::kStateTable.rend(); ++rule)
        check_answer(client.ask(rule->method, params_for(rule->method, 0)), *rule, SimState::empty);
}

TEST_CASE("States.ALoadingServerAnswersAsTheTableSays") {
    TestServer server;
    Client client(server->control_endpoint());
    reach(client, SimState::loading);
    const server::StateRule* cancel = nullptr;
    for (const server::StateRule& rule : server::kStateTable) {
        if (rule.method == "sim.cancel")
            cancel = &rule;
        else
            check_answer(client.ask(rule.method, params_for(rule.method, 0)), rule, SimState::loading);
    }
    // Were it not loading any more, the answers above would say nothing.
    REQUIRE(state_of(client) == "loading");
    REQUIRE(cancel != nullptr);
    check_answer(client.ask("sim.cancel"), *cancel, SimState::loading);
}

TEST_CASE("States.TheDescriptionCarriesTheTable") {
    TestServer server;
    Client client(server->control_endpoint());
    const Json table = client.call("describe").at("x-state");
    REQUIRE(table.size() == server::kStateTable.size());
    for (std::size_t k = 0; k < table.size(); ++k) {
        CHECK(table[k]["method"] == server::kStateTable[k].method);
        CHECK(table[k]["running"] == server::kStateTable[k].running);
    }
}
