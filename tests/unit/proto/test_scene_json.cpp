#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "proto/messages_json.h"
#include "proto/presets.h"

using namespace headrace::proto;

namespace {

// A small valid scene; tests change it in one place.
Json scene_json(int dimensions = 3) {
    auto json = parse_json(R"({
        "$schema": "scene.schema.json", "headrace_scene": 1, "name": "small", "description": "a drop",
        "dimensions": 3, "model": "thesis", "parameters": {"time_step": 0.001, "gravity": [0, -9.81, 0]},
        "spacing": 0.1, "domain": {"min": [-1, -1, -1], "max": [2, 2, 2]},
        "fluids": [{"name": "drop", "shape": {"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}, "velocity": [1, 2, 3]},
                   {"name": "rain", "shape": {"sphere": {"center": [1, 1, 1], "radius": 0.5}}}],
        "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0, 0], "max": [2, 2, 2]}}},
                    {"name": "ball", "shape": {"sphere": {"center": [1, 1, 1], "radius": 0.2}}}],
        "events": [{"at_rest": true, "action": {"remove_object": {"name": "ball"}}},
                   {"time": 0.5, "action": {"move_object": {"name": "ball", "to": [1, 2, 1]}}},
                   {"step": 9, "action": {"set_parameters": {"parameters": {"viscosity": 2}}}},
                   {"step": 10, "action": {"pause": {}}}],
        "at_rest": {"speed_factor": 0.02, "share": 0.99, "duration": 0.2, "timeout": 12},
        "output": {"interval": 0.05, "fields": ["id", "density"]}})");
    REQUIRE(json.ok());
    if (dimensions == 2) {
        (*json)["dimensions"] = 2;
        (*json)["parameters"]["gravity"] = {0, -9.81};
        (*json)["domain"] = *parse_json(R"({"min": [-1, -1], "max": [2, 2]})");
        (*json)["fluids"] = *parse_json(R"([{"name": "drop", "shape": {"box": {"min": [0, 0], "max": [1, 1]}}}])");
        (*json)["objects"] = Json::array();
        (*json)["events"] = Json::array();
    }
    return *json;
}

Json& at(Json& json, const char* pointer) {
    return json.at(Json::json_pointer(pointer));
}

// Puts `text` at a JSON pointer and says why the scene is refused: "path: message".
std::string why(const char* pointer, const char* text, int dimensions = 3) {
    Json json = scene_json(dimensions);
    json[Json::json_pointer(pointer)] = *parse_json(text);
    const auto scene = from_json<SceneDesc>(json, "params.scene");
    return scene ? "taken" : scene.error().path + ": " + scene.error().message;
}

}  // namespace

TEST_CASE("Scene.ValuesReachTheirMembers") {
    const auto scene = parse_scene(scene_json().dump());
    if (!scene) FAIL(scene.error().path << ": " << scene.error().message);
    CHECK(scene->name == "small");
    CHECK(scene->description == "a drop");
    CHECK(scene->dimensions == 3);
    CHECK(scene->model == "thesis");
    CHECK(std::get<Vec3>(scene->parameters.at("gravity")) == Vec3{0, -9.81, 0});
    CHECK(scene->spacing == 0.1);
    CHECK(scene->domain.min == Vec3{-1, -1, -1});
    CHECK(scene->domain.max == Vec3{2, 2, 2});
    REQUIRE(scene->fluids.size() == 2);
    CHECK(std::get<BoxDesc>(scene->fluids[0].shape).max == Vec3{1, 1, 1});
    CHECK(scene->fluids[0].velocity == ScalarVec3{1.0, 2.0, 3.0});
    CHECK(scene->objects[0].role == ObjectRole::container);
    CHECK(scene->objects[1].role == ObjectRole::obstacle);
    REQUIRE(scene->events.size() == 4);
    CHECK(scene->events[0].at_rest);
    CHECK(std::get<RemoveObjectAction>(scene->events[0].action).name == "ball");
    CHECK_FALSE(scene->events[1].at_rest);
    CHECK(scene->events[1].time == 0.5);
    CHECK(std::get<MoveObjectAction>(scene->events[1].action).to == Vec3{1, 2, 1});
    CHECK(scene->events[2].step == 9);
    CHECK(std::get<double>(std::get<SetParametersAction>(scene->events[2].action).parameters.at("viscosity")) == 2.0);
    CHECK(std::holds_alternative<PauseAction>(scene->events[3].action));
    CHECK(scene->at_rest.speed_factor == 0.02);
    CHECK(scene->at_rest.share == 0.99);
    CHECK(scene->at_rest.duration == 0.2);
    CHECK(scene->at_rest.timeout == 12.0);
    CHECK(scene->output.interval == 0.05);
    CHECK(scene->output.fields == FieldSet{Field::id, Field::density});
}

TEST_CASE("Scene.RoundTrips") {
    Json expected = scene_json();
    expected.erase("$schema");
    expected["fluids"][1]["velocity"] = {0, 0, 0};
    expected["objects"][1]["role"] = "obstacle";
    const auto scene = parse_scene(expected.dump());
    REQUIRE(scene.ok());
    const std::string text = scene_text(*scene);
    // Compared by value: parameters come back in alphabetical order, whole numbers as floating-point ones.
    CHECK(nlohmann::json::parse(text) == nlohmann::json::parse(expected.dump()));
    CHECK(scene_text(*parse_scene(text)) == text);
}

TEST_CASE("Scene.PresetsAreValid") {
    REQUIRE_FALSE(presets().empty());
    for (const Preset& preset : presets()) {
        CAPTURE(preset.name);
        const auto scene = parse_scene(preset.json);
        if (!scene) FAIL(scene.error().path << ": " << scene.error().message);
        CHECK(scene->name == preset.name);
    }
}

TEST_CASE("Scene.NeedsItsVersion") {
    Json json = scene_json();
    json.erase("headrace_scene");
    CHECK(from_json<SceneDesc>(json, "").error().path == "headrace_scene");
    CHECK(why("/headrace_scene", "2") == "params.scene.headrace_scene: must be 1, got 2");
    CHECK(why("/$schema", "3") == "params.scene.$schema: must be a string, got 3");
}

TEST_CASE("Scene.RefusalsNameTheDeepestPath") {
    CHECK(why("/fluids/0/shape/box/min/1", "\"x\"") ==
          "params.scene.fluids[0].shape.box.min[1]: must be a number [m], got the string \"x\"");
    CHECK(why("/fluids/0/shape/box/max/2", "0") ==
          "params.scene.fluids[0].shape.box.max[2]: must be greater than min along z");
    CHECK(why("/domain/min/0", "2") == "params.scene.domain.max[0]: must be greater than min along x");
    CHECK(why("/fluids/1/shape/sphere/radius", "0") ==
          "params.scene.fluids[1].shape.sphere.radius: must be greater than 0 m, got 0");
    CHECK(why("/fluids/1/shape", "{\"cube\": {}}") == "params.scene.fluids[1].shape.cube: unknown member \"cube\"");
    CHECK(why("/fluids/1/shape", "{}") ==
          "params.scene.fluids[1].shape: must be an object with one member out of box, sphere, cylinder, plane, "
          "difference, intersection, got 0 members");
    CHECK(why("/spacing", "-0.1") == "params.scene.spacing: must be greater than 0 m, got -0.1");
    CHECK(why("/spaceing", "0.1") == "params.scene.spaceing: unknown member \"spaceing\"");
    CHECK(why("/dimensions", "4") == "params.scene.dimensions: must be at least 2 and at most 3, got 4");
    CHECK(why("/at_rest/share", "1.5") == "params.scene.at_rest.share: must be greater than 0 and at most 1, got 1.5");
    CHECK(why("/at_rest/share", "1") == "taken");
    CHECK(why("/fluids", "[]") == "params.scene.fluids: must have at least 1 items");
    CHECK(why("/objects/1/name", "\"tank\"") == "params.scene.objects[1].name: is used twice: \"tank\"");
    CHECK(why("/output/fields/0", "\"mass\"") == "params.scene.output.fields[0]: unknown field \"mass\"");
}

TEST_CASE("Scene.EventsHaveOneTriggerAndOneAction") {
    CHECK(why("/events/0/step", "4") == "params.scene.events[0].step: cannot be given together with at_rest");
    CHECK(why("/events/3", R"({"action": {"pause": {}}})") ==
          "params.scene.events[3]: needs one of at_rest, time, step, probe");
    CHECK(why("/events/3/action", R"({"pause": {}, "remove_object": {"name": "a"}})") ==
          "params.scene.events[3].action: must be an object with one member out of remove_object, move_object, "
          "set_parameters, pause, got 2 members");
    CHECK(why("/events/1/time", "-1") == "params.scene.events[1].time: must be at least 0 s, got -1");
}

TEST_CASE("Scene.VectorsMatchItsDimensions") {
    CHECK(why("/name", "\"flat\"", 2) == "taken");
    CHECK(why("/domain/min", "[-1, -1]") ==
          "params.scene.domain.min: must be an array of 3 numbers [m], got an array of 2");
    CHECK(why("/parameters/gravity", "[0, -9.81]") ==
          "params.scene.parameters.gravity: must be an array of 3 numbers, got an array of 2");
    CHECK(why("/domain/min", "[-1, -1, 0]", 2) == "taken");
    CHECK(why("/domain/min", "[-1, -1, 0.5]", 2) ==
          "params.scene.domain.min[2]: must be 0 in a scene of 2 dimensions, got 0.5");
    CHECK(why("/domain/max", "[2, -1]", 2) == "params.scene.domain.max[1]: must be greater than min along y");
}

TEST_CASE("Scene.HasAtMostAThousandObjects") {
    Json json = scene_json();
    json["events"] = Json::array();
    Json& objects = at(json, "/objects");
    const Json ball = objects[1];
    while (objects.size() < 1000) {
        objects.push_back(ball);
        objects.back()["name"] = "ball" + std::to_string(objects.size());
    }
    CHECK(from_json<SceneDesc>(json, "").ok());
    objects.push_back(ball);
    CHECK(from_json<SceneDesc>(json, "").error().message == "must have at most 1000 items, got 1001");
}

TEST_CASE("Scene.DoesNotPutItsDimensionsOnOtherMessages") {
    // The scene's rule for vectors ends with the scene.
    Json load = Json::object();
    load["scene"] = scene_json(3);
    load["parameters"]["gravity"] = {0, -1};
    CHECK(from_json<SceneLoad>(load, "params").ok());
}
