#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/support/schema_files.h"

using namespace headrace;

namespace {

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

}  // namespace

// When this fails after a change of a message or of the preset dam_break, build and run headrace_schemas and look at
// what changed.
TEST_CASE("Schemas.FilesAreWhatTheCodeSays") {
    for (const auto& [name, text] : test::schema_files()) {
        CAPTURE(name);
        const bool is_fresh = text_of(test::schema_folder() / name) == text;
        CHECK(is_fresh);
    }
}

TEST_CASE("Schemas.FolderHoldsNothingElse") {
    std::set<std::string> expected;
    for (const auto& [name, text] : test::schema_files()) expected.insert(name);
    for (const char* name : {"event", "error"}) expected.insert(std::string(name) + ".example.json");
    for (const proto::MethodInfo& method : proto::kMethods) expected.insert(std::string(method.name) + ".example.json");
    std::set<std::string> present;
    for (const auto& entry : std::filesystem::directory_iterator(test::schema_folder()))
        present.insert(entry.path().filename().string());
    CHECK(present == expected);
}

TEST_CASE("Schemas.ErrorExampleIsWhatTheRequestGets") {
    const auto example = proto::parse_json(text_of(test::schema_folder() / "error.example.json"));
    REQUIRE(example.ok());
    const auto run = proto::from_json<proto::SimRun>((*example)["request"]["params"], "params");
    REQUIRE_FALSE(run.ok());
    CHECK(proto::error_json(run.error()) == (*example)["reply"]["error"]);
}

TEST_CASE("Schemas.StateTypesUnitsRangesAndDefaults") {
    const proto::Json schema = proto::json_schema<proto::StreamOpen>();
    const proto::Json& window = schema["properties"]["window"];
    CHECK(window["type"] == "integer");
    CHECK(window["x-unit"] == "1");
    CHECK(window["minimum"] == 1);
    CHECK(window["maximum"] == 1024);
    CHECK(window["default"] == 16);
    CHECK_FALSE(window["description"].get<std::string>().empty());
    CHECK(schema["properties"]["interval"]["exclusiveMinimum"] == 0);
    CHECK_FALSE(schema["properties"]["interval"].contains("default"));
    CHECK(schema["additionalProperties"] == false);
    CHECK(proto::json_schema<proto::ObjectsRemove>()["required"] == proto::Json::array({"name"}));
}

TEST_CASE("Schemas.AreNullForUnknownMethods") {
    CHECK(proto::method_params_schema("sim.fly").is_null());
    CHECK(proto::method_result_schema("sim.fly").is_null());
    CHECK(proto::method_params_schema("sim.run")["title"] == "SimRun");
    CHECK(proto::method_result_schema("sim.run")["title"] == "JobReply");
}
