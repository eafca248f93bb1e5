// Expressions, tables, shapes made of shapes, motion, periodic axes and starts in the scene document.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "proto/messages_json.h"

using namespace headrace::proto;

namespace {

Json parsed(const char* text) {
    const auto json = parse_json(text);
    if (!json) FAIL(json.error().message);
    return *json;
}

// Everything of the language once; tests change it in one place.
Json rich_scene(int dimensions = 3) {
    if (dimensions == 2)
        return parsed(R"json({
            "headrace_scene": 1, "name": "flat", "dimensions": 2, "spacing": 0.1,
            "domain": {"min": [0, 0], "max": [1, 1], "periodic": [true, true]},
            "body_force": ["sin(2*pi*y)", 0],
            "fluids": [{"name": "all", "shape": {"box": {"min": [0, 0], "max": [1, 1]}},
                        "velocity": ["sin(2*pi*x)*cos(2*pi*y)", "-cos(2*pi*x)*sin(2*pi*y)"],
                        "pressure": "x + y", "start": {"jitter": 0.2, "seed": 7}}],
            "objects": [{"name": "lid", "shape": {"plane": {"point": [0, 1], "normal": [0, -1]}},
                         "slip": "no_slip", "surface_velocity": ["min(t, 1)", 0]}]
})json");
    return parsed(R"json({
        "headrace_scene": 1, "name": "rich", "dimensions": 3, "spacing": 0.1,
        "domain": {"min": [-2, -2, -2], "max": [2, 2, 2], "periodic": [true, false, false]},
        "frame_acceleration": {"table": [[0, 0, 0, 0], [0.5, 1, 0, 0], [1, 0, 0, 0]]},
        "fluids": [{"name": "ring", "hydrostatic": true, "start": {"relaxed": true},
                    "shape": {"difference": {"of": [
                        {"cylinder": {"from": [0, 0, 0], "to": [0, 1, 0], "radius": 1}},
                        {"intersection": {"of": [{"sphere": {"center": [0, 0, 0], "radius": 0.5}},
                                                 {"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}}]}}]}}}],
        "objects": [{"name": "paddle", "shape": {"box": {"min": [1, 0, 0], "max": [1.1, 1, 1]}},
                     "motion": {"displacement": ["0.1*sin(t)", 0, 0], "angle": {"table": [[0, 0], [1, 0.5]]},
                                "pivot": [1, 0, 0], "axis": [0, 1, 0]
}
},
                    {"name": "pipe", "role": "container",
                     "shape": {"cylinder": {"from": [0, 0, 0], "to": [0, 1, 0], "radius": 1}}}]
})json");
}

std::string why(const char* pointer, const char* text, int dimensions = 3) {
    Json json = rich_scene(dimensions);
    json[Json::json_pointer(pointer)] = parsed(text);
    const auto scene = from_json<SceneDesc>(json, "scene");
    return scene ? "taken" : scene.error().path + ": " + scene.error().message;
}

}  // namespace

TEST_CASE("SceneLanguage.ValuesReachTheirMembers") {
    const auto scene = parse_scene(rich_scene().dump());
    if (!scene) FAIL(scene.error().path << ": " << scene.error().message);
    CHECK(scene->domain.periodic == std::array<bool, 3>{true, false, false});
    CHECK(std::get<TableDesc>(*scene->frame_acceleration).rows[1] == std::vector<double>{0.5, 1, 0, 0});
    const FluidDesc& ring = scene->fluids[0];
    CHECK(ring.hydrostatic);
    CHECK(ring.start.relaxed);
    CHECK_FALSE(ring.pressure);
    const auto& difference = std::get<DifferenceDesc>(ring.shape);
    CHECK(std::get<CylinderDesc>(difference.of[0]) == CylinderDesc{{0, 0, 0}, {0, 1, 0}, 1});
    const auto& intersection = std::get<IntersectionDesc>(difference.of[1]);
    CHECK(std::get<PlaneDesc>(intersection.of[1]).normal == Vec3{0, 1, 0});
    const MotionDesc& motion = *scene->objects[0].motion;
    CHECK(std::get<ScalarVec3>(*motion.displacement) == ScalarVec3{std::string("0.1*sin(t)"), 0.0, 0.0});
    CHECK(std::get<TableDesc>(*motion.angle).rows.size() == 2);
    CHECK(motion.pivot == Vec3{1, 0, 0});
    CHECK(motion.axis == Vec3{0, 1, 0});

    const auto flat = parse_scene(rich_scene(2).dump());
    if (!flat) FAIL(flat.error().path << ": " << flat.error().message);
    CHECK(flat->domain.periodic == std::array<bool, 3>{true, true, false});
    CHECK(flat->body_force == ScalarVec3{std::string("sin(2*pi*y)"), 0.0, 0.0});
    CHECK(flat->fluids[0].pressure == Scalar(std::string("x + y")));
    CHECK(flat->fluids[0].start == FluidStartDesc{false, 0.2, 7});
    CHECK(flat->objects[0].slip == WallSlip::no_slip);
    CHECK(flat->objects[0].surface_velocity == ScalarVec3{std::string("min(t, 1)"), 0.0, 0.0});
}

TEST_CASE("SceneLanguage.RoundTrips") {
    for (const int dimensions : {2, 3}) {
        const auto scene = parse_scene(rich_scene(dimensions).dump());
        REQUIRE(scene.ok());
        const std::string text = scene_text(*scene);
        const auto again = parse_scene(text);
        if (!again) FAIL(again.error().path << ": " << again.error().message);
        CHECK(scene_text(*again) == text);
        CHECK(again->fluids[0].shape == scene->fluids[0].shape);
        CHECK(again->body_force == scene->body_force);
        CHECK(again->fluids[0].start == scene->fluids[0].start);
        CHECK(again->objects[0].shape == scene->objects[0].shape);
    }
}

TEST_CASE("SceneLanguage.WhatIsNotUsedIsNotWritten") {
    const auto scene = parse_scene(R"json({"headrace_scene": 1, "name": "plain", "spacing": 0.1,
        "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
        "fluids": [{"name": "a", "shape": {"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}}],
        "objects": [{"name": "b", "shape": {"sphere": {"center": [0, 0, 0], "radius": 1}}}]})json");
    REQUIRE(scene.ok());
    const Json json = to_json(*scene);
    CHECK(json["fluids"][0].size() == 3);   // name, shape, velocity
    CHECK(json["objects"][0].size() == 3);  // name, role, shape
    CHECK(json["domain"].size() == 2);
    for (const char* member : {"body_force", "frame_acceleration", "probes"}) CHECK_FALSE(json.contains(member));
}

TEST_CASE("SceneLanguage.ExpressionsStandWhereNumbersDo") {
    CHECK(why("/fluids/0/velocity", R"json(["x", 1, "z"])json") == "taken");
    CHECK(why("/fluids/0/velocity", R"json([true, 1, 2])json") ==
          "scene.fluids[0].velocity[0]: must be a number or an expression [m/s], got true");
    CHECK(why("/fluids/0/velocity", R"json("x")json") ==
          "scene.fluids[0].velocity: must be an array of 3 numbers or expressions [m/s], got the string \"x\"");
    CHECK(why("/fluids/0/velocity", R"json(["x", "y", "0"])json", 2) ==
          "scene.fluids[0].velocity[2]: must be 0 in a scene of 2 dimensions, got the string \"0\"");
    const std::string endless = "\"" + std::string(1001, '1') + "\"";
    CHECK(why("/body_force", ("[" + endless + ", 0, 0]").c_str()) ==
          "scene.body_force[0]: must have at most 1000 characters");
    CHECK(why("/objects/0/surface_velocity", R"json({"table": [[0, 0, 0, 0], [1, 1, 1, 1]]})json") ==
          "scene.objects[0].surface_velocity: must be an array of 3 numbers or expressions [m/s], got an object");
}

TEST_CASE("SceneLanguage.TablesAreRowsOfNumbers") {
    CHECK(why("/frame_acceleration", R"json(["sin(t)", 0, 0])json") == "taken");
    CHECK(why("/frame_acceleration", R"json({"rows": []})json") ==
          "scene.frame_acceleration.rows: unknown member \"rows\"");
    CHECK(why("/frame_acceleration", R"json({"table": [[0, 0, 0, 0]]})json") ==
          "scene.frame_acceleration.table: must have at least 2 items");
    CHECK(why("/frame_acceleration", R"json({"table": [[0, 0, 0, 0], [1, "t", 0, 0]]})json") ==
          "scene.frame_acceleration.table[1][1]: must be a number, got the string \"t\"");
    CHECK(why("/frame_acceleration", "3") ==
          "scene.frame_acceleration: must be an array of 3 numbers or expressions [m/s^2], got 3");
    CHECK(why("/objects/0/motion/angle", "[1]") ==
          "scene.objects[0].motion.angle: must be a number or an expression [rad], got an array of 1");
}

TEST_CASE("SceneLanguage.ShapesAreCheckedAtAnyDepth") {
    CHECK(why("/fluids/0/shape/difference/of/1/intersection/of/0/sphere/radius", "-1") ==
          "scene.fluids[0].shape.difference.of[1].intersection.of[0].sphere.radius: must be greater than 0 m, got -1");
    CHECK(why("/fluids/0/shape", R"json({"difference": {"of": []}})json") ==
          "scene.fluids[0].shape.difference.of: must have at least 2 items");
    CHECK(why("/fluids/0/shape/difference/of/1/intersection/of/1/plane/normal", "[0, 0, 0]") ==
          "scene.fluids[0].shape.difference.of[1].intersection.of[1].plane.normal: must not be zero");
    CHECK(why("/objects/1/shape/cylinder/to", "[0, 0, 0]") ==
          "scene.objects[1].shape.cylinder.to: must differ from `from`");
    CHECK(why("/objects/0/shape", R"json({"cylinder": {"from": [0, 0], "to": [0, 1], "radius": 1}})json", 2) ==
          "scene.objects[0].shape.cylinder: is for 3 dimensions only");
    CHECK(why("/objects/1/shape", rich_scene()["fluids"][0]["shape"].dump().c_str()) ==
          "scene.objects[1].shape: must be a box, a sphere, a cylinder or a plane");
}

TEST_CASE("SceneLanguage.OtherMembersAreChecked") {
    CHECK(why("/domain/periodic", "[true]") ==
          "scene.domain.periodic: must be an array of 3 true or false, got an array of 1");
    CHECK(why("/domain/periodic", "[1, 0, 0]") == "scene.domain.periodic[0]: must be true or false, got 1");
    CHECK(why("/domain/periodic", "[true, true, true]", 2) ==
          "scene.domain.periodic[2]: must be false in a scene of 2 dimensions, got true");
    CHECK(why("/fluids/0/pressure", "1") == "scene.fluids[0].hydrostatic: cannot be given together with pressure");
    CHECK(why("/fluids/0/hydrostatic", "false") == "scene.fluids[0].hydrostatic: must be true, got false");
    CHECK(why("/fluids/0/start/jitter", "0.6") ==
          "scene.fluids[0].start.jitter: must be at least 0 and at most 0.5, got 0.6");
    CHECK(why("/fluids/0/start/seed", "0.5") == "scene.fluids[0].start.seed: must be an integer, got 0.5");
    CHECK(why("/objects/0/slip", "\"free\"") ==
          "scene.objects[0].slip: must be one of free_slip, no_slip, got \"free\"");
    CHECK(why("/objects/0/motion/axis", "[0, 0, 0]") == "scene.objects[0].motion.axis: must not be zero");
    CHECK(why("/objects/0/motion/angel", "1") == "scene.objects[0].motion.angel: unknown member \"angel\"");
}

TEST_CASE("SceneLanguage.ItsSchemaRefersToShapesByName") {
    const Json schema = json_schema<SceneDesc>();
    CHECK(schema["properties"]["fluids"]["items"]["properties"]["shape"]["$ref"] == "#/$defs/shape");
    const Json& shape = schema["$defs"]["shape"];
    CHECK(shape["oneOf"].size() == 6);
    CHECK(shape["oneOf"][4]["properties"]["difference"]["properties"]["of"]["items"]["$ref"] == "#/$defs/shape");
    const Json& frame = schema["properties"]["frame_acceleration"]["anyOf"];
    CHECK(frame[0]["items"]["type"] == Json::array({"number", "string"}));
    CHECK(frame[1]["required"] == Json::array({"table"}));
    const Json load = json_schema<SceneLoad>();
    CHECK(load["properties"]["scene"]["anyOf"][1]["properties"].contains("fluids"));
    CHECK(load["$defs"].contains("shape"));
    // Objects are primitives: written out, no reference.
    CHECK(schema["properties"]["objects"]["items"]["properties"]["shape"]["oneOf"].size() == 4);
    CHECK_FALSE(json_schema<ObjectsAdd>().contains("$defs"));
}
