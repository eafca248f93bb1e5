// The scenes in the protocol's examples are scenes that the server takes.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "proto/messages_json.h"
#include "proto/presets.h"
#include "server/scene/validate.h"

using namespace headrace;

TEST_CASE("Examples.TheirScenesMakeSense") {
    const auto file = GENERATE(as<std::string>{}, "scene.example.json", "scene.get.example.json");
    INFO(file);
    std::ifstream in(std::string(HEADRACE_SOURCE_DIR "/proto/schemas/") + file);
    std::stringstream text;
    text << in.rdbuf();
    auto json = proto::parse_json(text.str());
    REQUIRE(json.ok());
    const proto::Json scene_json = json->contains("reply") ? (*json)["reply"]["result"] : *json;
    const auto scene = proto::from_json<proto::SceneDesc>(scene_json, "scene");
    REQUIRE(scene.ok());
    scene::BuildControl control;
    const proto::Status valid = scene::validate(*scene, control);
    CHECK(valid.ok());
    CHECK(scene->at_rest.duration > 0.0);
}

TEST_CASE("Presets.AllMakeSense") {
    REQUIRE(proto::presets().size() >= 7);
    for (const proto::Preset& preset : proto::presets()) {
        INFO(preset.name);
        const auto scene = proto::parse_scene(preset.json);
        REQUIRE(scene.ok());
        CHECK(scene->name == preset.name);
        scene::BuildControl control;
        CHECK(scene::validate(*scene, control).ok());
    }
}

TEST_CASE("Validate.StopsWhenItIsCancelled") {
    const auto scene = proto::parse_scene(proto::presets().front().json);
    REQUIRE(scene.ok());
    scene::BuildControl control;
    control.cancelled = true;
    const proto::Status outcome = scene::validate(*scene, control);
    REQUIRE_FALSE(outcome.ok());
    CHECK(outcome.error().code == proto::ErrorCode::cancelled);
}
