#include <catch2/catch.hpp>
#include <string>

#include "proto/methods.h"
#include "server/state_table.h"

using namespace headrace;
using proto::SimState;

TEST_CASE("StateTable.NamesOnlyMethodsThatExist") {
    for (const server::StateRule& rule : server::kStateTable) {
        INFO(rule.method);
        CHECK(proto::find_method(rule.method) != nullptr);
    }
}

TEST_CASE("StateTable.RefusalNamesStateAllowedStatesAndRemedy") {
    const auto error = server::refuse_in_state("sim.step", SimState::empty);
    REQUIRE(error);
    CHECK(error->code == proto::ErrorCode::wrong_state);
    CHECK(error->message == "sim.step is not allowed while empty; it is allowed while idle");
    CHECK(error->hint.find("scene.load") != std::string::npos);

    const auto running = server::refuse_in_state("scene.load", SimState::running);
    REQUIRE(running);
    CHECK(running->message.find("empty, idle, faulted") != std::string::npos);
    CHECK(running->hint.find("sim.cancel") != std::string::npos);

    const auto faulted = server::refuse_in_state("params.set", SimState::faulted);
    REQUIRE(faulted);
    CHECK(faulted->hint.find("sim.reset") != std::string::npos);
}

TEST_CASE("StateTable.LoadingIsBusyAndWorthAskingAgain") {
    const auto error = server::refuse_in_state("sim.run", SimState::loading);
    REQUIRE(error);
    CHECK(error->code == proto::ErrorCode::busy);
    CHECK(proto::error_info(error->code).retryable);
}

TEST_CASE("StateTable.AllowsWhatItSaysAndWhatItDoesNotList") {
    CHECK_FALSE(server::refuse_in_state("sim.step", SimState::idle));
    CHECK_FALSE(server::refuse_in_state("sim.cancel", SimState::empty));
    CHECK_FALSE(server::refuse_in_state("hello", SimState::faulted));
}
