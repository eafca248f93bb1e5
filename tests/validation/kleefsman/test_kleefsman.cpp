#include <catch2/catch.hpp>

#include "tests/validation/support/case.h"

using namespace headrace;
using namespace headrace::validation;

TEST_CASE("Kleefsman.SceneLoadsWithTheExperimentsWalls") {
    const Case* one = find_case("kleefsman");
    REQUIRE(one != nullptr);
    Settings settings;
    settings.resolution = 5;
    const auto scene = make_scene(*one, settings);
    REQUIRE(scene.ok());
    REQUIRE(scene->objects.size() == 2);
    const auto& box = std::get<proto::BoxDesc>(scene->objects[1].shape);
    CHECK(box.max[0] == 0.8245);  // the face that is hit first
    CHECK(box.max[2] - box.min[2] == Approx(0.403));
    const auto run = scene::Run::build(*scene);
    REQUIRE(run.ok());
    // 1.228 x 0.55 x 1 m^3 in cubes of 0.11 m, whole cubes per axis.
    CHECK((*run)->particles().size() == 11 * 5 * 9);
}
