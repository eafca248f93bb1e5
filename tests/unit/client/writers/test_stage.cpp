// What the pictures of a recording show.
#include <algorithm>
#include <catch2/catch.hpp>

#include "client/writers/block_faces.h"
#include "client/writers/boxes.h"
#include "client/writers/scene_renderer.h"
#include "client/writers/stage.h"
#include "tests/unit/client/writers/synthetic.h"

using namespace headrace;
using namespace headrace::client;
using namespace headrace::tests;

namespace {

// 1.6 m wide and 1.9 m high, with water to 0.3 m: mostly air.
proto::SceneDesc high_tank() {
    proto::SceneDesc scene = tank_scene();
    scene.dimensions = 2;
    scene.fluids = {{"column", proto::BoxDesc{{0, 0, 0}, {0.6, 0.3, 0}}, {}}};
    scene.objects = {{"walls", proto::ObjectRole::container, proto::BoxDesc{{0, 0, 0}, {1.6, 1.9, 0}}}};
    return scene;
}

Extents extents_of(const proto::BoxDesc& fluid, const proto::BoxDesc& containers) {
    Extents extents;
    extents.fluid = fluid;
    extents.containers = containers;
    return extents;
}

constexpr Viewport kWindow{20, 20, 320, 200};  // [px]

WriterOptions options_of(const proto::SceneDesc& scene, const ViewOptions& view) {
    WriterOptions options;
    options.scene = scene;
    options.picture.view = view;
    return options;
}

}  // namespace

TEST_CASE("Stage.TheFluidFillsThePictureWhereItLeavesMuchEmpty") {
    const proto::SceneDesc scene = high_tank();
    const Extents low = extents_of({{0.01, 0.01, 0}, {1.59, 0.5, 0}}, {{0, 0, 0}, {1.6, 1.9, 0}});
    const Stage stage = make_stage(scene, {}, low);
    CHECK(stage.is_part);
    // All of the width, since the fluid reaches both walls, and the floor; above it 6 % of its width.
    CHECK(stage.bounds.min == Vec3{0, 0, 0});
    CHECK(stage.bounds.max[0] == 1.6);
    CHECK(stage.bounds.max[1] == Approx(0.5 + 0.06 * 1.58));

    // Nothing is gained where it splashes to the top.
    const Extents high = extents_of({{0.01, 0.01, 0}, {1.59, 1.8, 0}}, low.containers);
    CHECK_FALSE(make_stage(scene, {}, high).is_part);
    CHECK(make_stage(scene, {}, high).bounds == visible_bounds(scene));
    // Nor when all is asked for, or when nobody has looked at the frames.
    CHECK(make_stage(scene, {.whole = true}, low).bounds == visible_bounds(scene));
    CHECK(make_stage(scene).bounds == visible_bounds(scene));
}

TEST_CASE("Stage.ObstaclesThatCostLittleAreShown") {
    const proto::SceneDesc scene = high_tank();
    Extents extents = extents_of({{0.01, 0.01, 0}, {1.59, 0.8, 0}}, {{0, 0, 0}, {1.6, 1.9, 0}});
    const double top = make_stage(scene, {}, extents).bounds.max[1];
    extents.obstacles["panel"] = {{0.6, 0, 0}, {0.61, 0.95, 0}};
    CHECK(make_stage(scene, {}, extents).bounds.max[1] >= 0.95);
    extents.obstacles["panel"].max[1] = 1.9;
    CHECK(make_stage(scene, {}, extents).bounds.max[1] == top);
}

TEST_CASE("Stage.WithoutContainersAllThatTheFluidReachesIsShown") {
    proto::SceneDesc scene = high_tank();
    scene.objects.clear();
    const Stage stage = make_stage(scene, {}, extents_of({{-3, 0, 0}, {4, 1, 0}}, kNowhere));
    CHECK(stage.bounds.min[0] <= -3);
    CHECK(stage.bounds.max[0] >= 4);
}

// What a moving tank sweeps is in the picture of each frame: a film stands still.
TEST_CASE("Stage.MovingContainersStayInThePicture") {
    proto::SceneDesc scene = high_tank();
    scene.objects[0].motion.emplace();
    const Extents swept = extents_of({{-0.5, 0, 0}, {2.1, 1.8, 0}}, {{-0.5, -0.1, 0}, {2.1, 2.0, 0}});
    const Stage stage = make_stage(scene, {}, swept);
    CHECK(stage.bounds.min[0] == -0.5);
    CHECK(stage.bounds.max[0] == 2.1);
}

TEST_CASE("Stage.HighTanksAreCutOpenAboveTheFluid") {
    const proto::SceneDesc scene = tank_scene();
    const Extents low = extents_of({{0.01, 0.01, 0.01}, {0.99, 0.31, 0.39}}, {{0, 0, 0}, {1, 0.8, 0.4}});
    const Stage stage = make_stage(scene, {}, low);
    REQUIRE(stage.cutaway);
    CHECK(stage.bounds.max[1] == Approx(0.31 + 0.09 * 0.3));
    CHECK(stage.bounds.max[0] == 1);
    CHECK(stage.cutaway->axis == 1);
    CHECK(stage.cutaway->is_max);
    CHECK(stage.cutaway->at == stage.bounds.max[1]);
    proto::SceneDesc bowl = scene;
    bowl.objects[0].shape = proto::SphereDesc{{0.5, 0.4, 0.2}, 0.5};
    CHECK_FALSE(make_stage(bowl, {}, low).cutaway);
}

TEST_CASE("Stage.WhatIsCutOpenIsLowerAndNothingElse") {
    const Extents low = extents_of({{0.01, 0.01, 0.01}, {0.99, 0.31, 0.39}}, {{0, 0, 0}, {1, 0.8, 0.4}});
    Stage stage = make_stage(tank_scene(), {}, low);
    REQUIRE(stage.cutaway);
    const double top = stage.cutaway->at;
    const auto shown = [&](const proto::BoxDesc& box) {
        return shown_container(proto::ObjectDesc{"box", proto::ObjectRole::container, box}, stage);
    };
    // Wider than all that the stage shows.
    const OpenBlock wide = shown({{-1, 0, -2}, {3, 0.8, 5}});
    CHECK(bounds_of(wide.block.corners) == proto::BoxDesc{{-1, 0, -2}, {3, top, 5}});
    REQUIRE(wide.open != nullptr);
    CHECK(wide.open->axis == 1);
    CHECK(wide.open->is_max);
    const proto::BoxDesc below{{0, 0, 0}, {1, top, 0.4}}, above{{0, 0.7, 0}, {1, 0.8, 0.4}};
    for (const proto::BoxDesc& box : {below, above}) {
        CHECK(bounds_of(shown(box).block.corners) == box);
        CHECK(shown(box).open == nullptr);
    }
    // Where down is up, the lower end is cut off.
    stage.cutaway = Cutaway{2, false, 0.1};
    CHECK(bounds_of(shown({{0, 0, 0}, {1, 1, 1}}).block.corners) == proto::BoxDesc{{0, 0, 0.1}, {1, 1, 1}});
    CHECK(shown({{0, 0, 0}, {1, 1, 1}}).open->axis == 2);
    CHECK_FALSE(shown({{0, 0, 0}, {1, 1, 1}}).open->is_max);
}

TEST_CASE("Stage.ACropFillsThePictureAndHidesTheRest") {
    const proto::SceneDesc scene = high_tank();
    ViewOptions view;
    view.crop = proto::BoxDesc{{0.4, 0.1, 0}, {0.8, 0.3, 0}};
    const Stage stage = make_stage(scene, view);
    SceneRenderer renderer(scene, stage, {}, 360, 240, kWindow, view);
    // 0.4 m over 320 px.
    CHECK(renderer.camera().pixels_per_metre(0) == Approx(800));
    CHECK(renderer.camera().project({0.4, 0.2, 0}).x == Approx(20));
    CHECK(renderer.camera().project({0.8, 0.2, 0}).x == Approx(340));
    const std::vector<Vec3> places{{0.6, 0.2, 0}, {0.6, 0.32, 0}};
    const std::vector<float> values{0, 0};
    const Image image = renderer.draw(places, values, {});
    const auto seen_at = [&](const Vec3& x) {
        const Projected p = renderer.camera().project(x);
        return image.at(static_cast<int>(p.x), static_cast<int>(p.y));
    };
    CHECK(seen_at(places[0]) != kPaper);
    CHECK(seen_at(places[1]) == kPaper);
}

TEST_CASE("Stage.ACropHidesTheRestAtEachZoom") {
    const proto::SceneDesc scene = high_tank();
    ViewOptions view;
    view.crop = proto::BoxDesc{{0.4, 0.1, 0}, {0.8, 0.3, 0}};
    view.zoom = 0.5;
    const Stage stage = make_stage(scene, view);
    const std::vector<Vec3> places{{0.6, 0.2, 0}, {0.6, 0.34, 0}, {0.36, 0.2, 0}};
    const auto is_drawn = [&](const SceneRenderer& renderer, const Image& image, const Vec3& x) {
        const Projected p = renderer.camera().project(x);
        return image.at(static_cast<int>(p.x), static_cast<int>(p.y)) != kPaper;
    };
    {
        const SceneRenderer renderer(scene, stage, {}, 360, 240, kWindow, view);
        const Image image = renderer.draw(places, std::vector<float>(3), at_rest(scene.objects));
        CHECK(is_drawn(renderer, image, places[0]));
        CHECK_FALSE(is_drawn(renderer, image, places[1]));
        CHECK_FALSE(is_drawn(renderer, image, places[2]));
        // Half of 320 px wide, and 2 px on each side for the line around it.
        REQUIRE(renderer.clip());
        CHECK(renderer.clip()->width == Approx(160 + 4));
    }
    // Large, it ends where pictures end.
    view.zoom = 3;
    CHECK(SceneRenderer(scene, stage, {}, 360, 240, kWindow, view).clip()->width == Approx(kWindow.width));
    // With the crop aside of the picture there is nothing, and no harm done.
    view.target = Vec3{5, 5, 0};
    const SceneRenderer aside(scene, stage, {}, 360, 240, kWindow, view);
    const Image image = aside.draw(places, std::vector<float>(3), at_rest(scene.objects));
    CHECK(std::ranges::count(image.pixels, Image::packed(kPaper)) == 360 * 240);
}

TEST_CASE("Stage.FramesAreLookedAtOnlyWhereTheyMatter") {
    ViewOptions corners, scene_view;
    corners.crop = proto::BoxDesc{{0, 0, 0}, {1, 1, 1}};
    scene_view.whole = true;
    proto::SceneDesc scene = tank_scene();
    CHECK(needed_reach(scene, {}) == Reach::objects_and_fluid);
    CHECK(needed_reach(scene, scene_view) == Reach::objects);
    CHECK(needed_reach(scene, corners) == Reach::nothing);
    // Bowls are not cut open.
    scene.objects[0].shape = proto::SphereDesc{{0.5, 0.4, 0.2}, 0.5};
    CHECK(needed_reach(scene, {}) == Reach::objects);
    // Nothing contains the fluid.
    scene.objects.clear();
    CHECK(needed_reach(scene, scene_view) == Reach::objects_and_fluid);
    CHECK(needed_reach(high_tank(), {}) == Reach::objects_and_fluid);
}

TEST_CASE("Stage.ZoomKeepsTheMiddleOrTheTarget") {
    const proto::SceneDesc scene = tank_scene();
    ViewOptions view;
    const Stage stage = make_stage(scene);
    const Camera whole = make_camera(scene, stage, view, kWindow);
    const Vec3 target{0.2, 0.1, 0.1};
    view.zoom = 3;
    const auto size_of = [&](const Camera& camera) {
        return camera.project(target + Vec3{0.1, 0, 0}).x - camera.project(target).x;
    };
    const Camera near = make_camera(scene, stage, view, kWindow);
    CHECK(size_of(near) == Approx(3 * size_of(whole)));
    const Camera::Ray middle = whole.ray(180, 120);
    const Projected still = near.project(middle.origin + middle.direction);
    CHECK(still.x == Approx(180));
    CHECK(still.y == Approx(120));

    view.position = Vec3{2, 1, 2};
    view.target = target;
    CHECK(make_camera(scene, stage, view, kWindow).project(target).x == Approx(180));
    CHECK(make_camera(scene, stage, view, kWindow).project(target).y == Approx(120));
}

TEST_CASE("Stage.ACropWithoutASizeIsRefused") {
    ViewOptions view;
    view.crop = proto::BoxDesc{{0, 0, 0}, {1, 1, 0}};  // a rectangle
    CHECK(check_view(options_of(high_tank(), view)).ok());
    const auto refused = check_view(options_of(tank_scene(), view));
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().hint.find("z0") != std::string::npos);
}
