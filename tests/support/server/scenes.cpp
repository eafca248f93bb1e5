#include "tests/support/server/scenes.h"

namespace headrace::test {

namespace {

Json box(const Json& min, const Json& max) {
    return {{"box", {{"min", min}, {"max", max}}}};
}

}  // namespace

Json pond() {
    return {{"headrace_scene", 1},
            {"name", "pond"},
            {"dimensions", 2},
            {"spacing", 0.01},
            {"parameters", {{"time_step", 1e-3}}},
            {"domain", {{"min", {-1, -1}}, {"max", {1, 1}}}},
            {"fluids", Json::array({{{"name", "water"}, {"shape", box({0, 0}, {0.1, 0.1})}}})},
            {"objects", Json::array({{{"name", "tank"}, {"role", "container"}, {"shape", box({0, 0}, {0.3, 0.3})}}})}};
}

Json doomed_drop() {
    Json scene = pond();
    scene["name"] = "doomed_drop";
    // Falls with 10 m/s from 0.05 m above the domain's floor: out within six steps of 1 ms.
    scene["domain"] = {{"min", {-0.1, -0.05}}, {"max", {0.2, 0.2}}};
    scene["fluids"][0]["velocity"] = {0, -10};
    scene["objects"] = Json::array();
    return scene;
}

Json deep_tank() {
    return {{"headrace_scene", 1},
            {"name", "deep_tank"},
            {"dimensions", 3},
            {"spacing", 0.01},
            {"domain", {{"min", {-1, -1, -1}}, {"max", {2, 2, 2}}}},
            // 32 x 48 x 64 particles.
            {"fluids", Json::array({{{"name", "water"}, {"shape", box({0, 0, 0}, {0.32, 0.48, 0.64})}}})},
            {"objects",
             Json::array({{{"name", "tank"}, {"role", "container"}, {"shape", box({0, 0, 0}, {0.64, 0.96, 0.64})}}})}};
}

Json lake() {
    Json scene = deep_tank();
    scene["name"] = "lake";
    // 100 x 100 x 200 particles.
    scene["fluids"][0]["shape"] = box({0, 0, 0}, {1, 1, 2});
    scene["objects"][0]["shape"] = box({0, 0, 0}, {2, 2, 2});
    return scene;
}

Json calm_pond() {
    Json scene = pond();
    scene["name"] = "calm_pond";
    scene["at_rest"] = {{"speed_factor", 1e6}, {"duration", 0.02}};
    return scene;
}

}  // namespace headrace::test
