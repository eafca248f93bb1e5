#include <catch2/catch.hpp>

#include "client/script.h"
#include "client/script_check.h"
#include "proto/methods.h"
#include "proto/version.h"

using namespace headrace;
using client::ScriptCommand;
using client::ScriptVariables;
using proto::Json;

namespace {

ScriptVariables variables(const std::vector<std::string>& assignments) {
    auto parsed = ScriptVariables::parse(assignments);
    REQUIRE(parsed.ok());
    return *parsed;
}

Json substituted(const std::vector<std::string>& assignments, const char* text) {
    ScriptVariables values = variables(assignments);
    Json json = Json::parse(text);
    REQUIRE(values.substitute(json).ok());
    return json;
}

// A document as `describe` gives it, of one method.
Json description(const std::string& version) {
    return {{"info", {{"version", version}}},
            {"methods",
             {{{"name", "sim.step"},
               {"x-socket", "control"},
               {"params", {{{"name", "steps"}, {"required", true}}, {{"name", "new_one"}, {"required", false}}}}}}}};
}

proto::Status check(const Json& params, const std::string& version) {
    return client::check_step({1, ScriptCommand{"sim.step", params}}, description(version));
}

}  // namespace

TEST_CASE("Script.AVariableThatStandsAloneKeepsItsType") {
    CHECK(substituted({"a=0.01"}, R"({"x": "${a}"})") == Json::parse(R"({"x": 0.01})"));
    CHECK(substituted({"a=[1, 2]", "b=true"}, R"(["${a}", "${b}"])") == Json::parse("[[1, 2], true]"));
    CHECK(substituted({"a=\"7\""}, R"("${a}")") == Json("7"));
    CHECK(substituted({"a=bowl"}, R"("${a}")") == Json("bowl"));
    CHECK(substituted({"a="}, R"("${a}")") == Json(""));
}

TEST_CASE("Script.AVariableInsideATextIsPutIntoIt") {
    CHECK(substituted({"a=0.5", "b=x"}, R"("run_${a}_${b}.mcap")") == Json("run_0.5_x.mcap"));
    CHECK(substituted({"a=1"}, R"("$${a} is ${a}")") == Json("${a} is 1"));
    CHECK(substituted({}, R"("5 $ and {a}")") == Json("5 $ and {a}"));
}

TEST_CASE("Script.AnInsertedValueIsNotLookedIntoAgain") {
    CHECK(substituted({"a=${b}", "b=1"}, R"("<${a}>")") == Json("<${b}>"));
}

TEST_CASE("Script.AVariableWithoutAValueIsAnErrorWithARemedy") {
    ScriptVariables values = variables({"viscosity=1"});
    Json json("${viscosty}");
    const auto outcome = values.substitute(json);
    REQUIRE_FALSE(outcome.ok());
    CHECK(outcome.error().hint == "did you mean \"viscosity\"?");
    Json open("${viscosity");
    CHECK_FALSE(values.substitute(open).ok());
}

TEST_CASE("Script.LinesAreCountedWithBlankOnesAndComments") {
    ScriptVariables none;
    const auto steps =
        client::parse_script("# first\n\n  {\"method\": \"sim.pause\"}\r\n\t# more\n{\"wait\": \"+2\"}", "s", {}, none);
    REQUIRE(steps.ok());
    REQUIRE(steps->size() == 2);
    CHECK((*steps)[0].line == 3);
    CHECK(std::get<ScriptCommand>((*steps)[0].what).method == "sim.pause");
    CHECK((*steps)[1].line == 5);
    CHECK(std::get<client::ScriptRun>((*steps)[1].what).until.duration == 2.0);
}

TEST_CASE("Script.WaitsKnowEndsAndEventsWithTheirTimeOuts") {
    ScriptVariables none;
    const auto steps = client::parse_script(R"({"wait": {"until": "gauge>0.3", "timeout": 2.5}}
{"wait": {"event": "job.ended", "timeout": 10}})",
                                            "s", {}, none);
    REQUIRE(steps.ok());
    const auto& run = std::get<client::ScriptRun>((*steps)[0].what);
    CHECK(run.until.probe.value().above == 0.3);
    CHECK(run.until.timeout == 2.5);
    const auto& event = std::get<client::ScriptEvent>((*steps)[1].what);
    CHECK(event.type == "job.ended");
    CHECK(event.timeout == 10.0);
}

TEST_CASE("Script.ALineIsHeldAgainstTheDescription") {
    CHECK(check({{"steps", 3}}, proto::kProgramVersion).ok());
    // The decoder of this version knows types and ranges ...
    const auto wrong = check({{"steps", "3"}}, proto::kProgramVersion);
    REQUIRE_FALSE(wrong.ok());
    CHECK(wrong.error().path == "params.steps");
    // ... a server of another one may take more than it.
    CHECK(check({{"steps", 3}, {"new_one", 1}}, "99.0").ok());
    CHECK_FALSE(check({{"steps", 3}, {"newer", 1}}, "99.0").ok());
    CHECK_FALSE(check({{"new_one", 3}}, "99.0").ok());
    const auto unknown = client::check_step({1, ScriptCommand{"sim.stop", {}}}, description("99.0"));
    REQUIRE_FALSE(unknown.ok());
    CHECK(unknown.error().code == proto::ErrorCode::method_not_found);
}
