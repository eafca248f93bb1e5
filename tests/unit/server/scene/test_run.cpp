#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "server/at_rest.h"
#include "server/scene/run.h"

using namespace headrace;

namespace {

// A cube of 4^3 particles in a roomy tank.
proto::SceneDesc small_scene() {
    proto::SceneDesc scene;
    scene.name = "small";
    scene.spacing = 0.025;
    scene.domain = {{-0.5, -0.5, -0.5}, {1.0, 1.0, 1.0}};
    scene.fluids.push_back({"water", proto::BoxDesc{{0, 0, 0}, {0.1, 0.1, 0.1}}, {}});
    scene.objects.push_back({"tank", proto::ObjectRole::container, proto::BoxDesc{{0, 0, 0}, {0.4, 0.4, 0.1}}});
    scene.objects.push_back({"ball", proto::ObjectRole::obstacle, proto::SphereDesc{{0.3, 0.1, 0.05}, 0.05}});
    return scene;
}

void check_refused(const proto::SceneDesc& scene, proto::ErrorCode code, const std::string& path) {
    const auto run = scene::Run::build(scene);
    REQUIRE_FALSE(run.ok());
    CHECK(run.error().code == code);
    CHECK(run.error().path == path);
    CHECK_FALSE(run.error().message.empty());
    CHECK_FALSE(run.error().hint.empty());
}

}  // namespace

TEST_CASE("Run.BuildsTheLatticeWithIdsInOrder") {
    auto run = scene::Run::build(small_scene());
    REQUIRE(run.ok());
    CHECK((*run)->particles().size() == 64);
    CHECK((*run)->fluid_height() == Approx(0.1));
    CHECK((*run)->step_number() == 0);
    std::vector<bool> seen(64, false);
    for (const auto id : (*run)->particles().id) seen.at(id) = true;
    CHECK(std::count(seen.begin(), seen.end(), true) == 64);
    (*run)->step();
    CHECK((*run)->step_number() == 1);
    CHECK((*run)->time() == Approx((*run)->last_report().dt));
}

TEST_CASE("Run.RefusesScenesThatMakeNoSense") {
    using proto::ErrorCode;
    proto::SceneDesc scene = small_scene();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    SECTION("dimensions") {
        scene.dimensions = 4;
        check_refused(scene, ErrorCode::scene_invalid, "scene.dimensions");
    }
    SECTION("spacing") {
        scene.spacing = GENERATE(0.0, -1.0, std::numeric_limits<double>::quiet_NaN());
        check_refused(scene, ErrorCode::scene_invalid, "scene.spacing");
    }
    SECTION("domain") {
        scene.domain.max[1] = -2.0;
        check_refused(scene, ErrorCode::scene_invalid, "scene.domain");
    }
    SECTION("model") {
        scene.model = "thesus";
        check_refused(scene, ErrorCode::scene_invalid, "scene.model");
    }
    SECTION("unknown parameter") {
        scene.parameters["viscosty"] = 3.5;
        check_refused(scene, ErrorCode::parameter_not_found, "scene.parameters.viscosty");
    }
    SECTION("bad parameter") {
        scene.parameters["time_step"] = GENERATE(0.0, -0.01);
        check_refused(scene, ErrorCode::scene_invalid, "scene.parameters.time_step");
    }
    SECTION("no fluid") {
        scene.fluids.clear();
        check_refused(scene, ErrorCode::scene_invalid, "scene.fluids");
    }
    SECTION("too many particles") {
        scene.spacing = 1e-6;
        check_refused(scene, ErrorCode::limit_exceeded, "scene.spacing");
    }
    SECTION("a fluid thinner than the spacing") {
        scene.spacing = 0.3;
        check_refused(scene, ErrorCode::scene_invalid, "scene.fluids[0].shape");
    }
    SECTION("fluid outside the domain") {
        scene.objects.clear();
        scene.domain.max[0] = 0.05;
        check_refused(scene, ErrorCode::scene_invalid, "scene.fluids[0].shape");
    }
    SECTION("fluid outside a container") {
        scene.objects[0].shape = proto::BoxDesc{{0, 0, 0}, {0.05, 0.4, 0.1}};
        check_refused(scene, ErrorCode::scene_invalid, "scene.fluids[0].shape");
    }
    SECTION("fluid inside an obstacle") {
        scene.objects[1].shape = proto::SphereDesc{{0.1, 0.1, 0.05}, 0.05};
        check_refused(scene, ErrorCode::scene_invalid, "scene.fluids[0].shape");
    }
    SECTION("two objects of one name") {
        scene.objects[1].name = "tank";
        check_refused(scene, ErrorCode::scene_invalid, "scene.objects[1].name");
    }
    SECTION("a shape that is not finite") {
        scene.objects[1].shape = proto::SphereDesc{{nan, 0.0, 0.0}, 0.05};
        check_refused(scene, ErrorCode::scene_invalid, "scene.objects[1].shape.sphere.center");
    }
    SECTION("an event about an object that is not there") {
        scene.events.push_back({true, {}, {}, {}, proto::RemoveObjectAction{"bal"}});
        check_refused(scene, ErrorCode::scene_invalid, "scene.events[0].action.remove_object.name");
    }
    SECTION("an event with an impossible parameter") {
        scene.events.push_back({true, {}, {}, {}, proto::SetParametersAction{{{"viscosity", -1.0}}}});
        check_refused(scene, ErrorCode::scene_invalid, "scene.events[0].action.set_parameters.viscosity");
    }
}

TEST_CASE("Run.ACancelledBuildSaysSo") {
    scene::BuildControl control;
    control.cancelled = true;
    const auto run = scene::Run::build(small_scene(), &control);
    REQUIRE_FALSE(run.ok());
    CHECK(run.error().code == proto::ErrorCode::cancelled);
}

TEST_CASE("Run.ObjectsCanBeAddedMovedAndRemovedByName") {
    auto built = scene::Run::build(small_scene());
    REQUIRE(built.ok());
    scene::Run& run = **built;
    CHECK(run.remove_object("ball").ok());
    CHECK(run.objects().size() == 1);
    const auto missing = run.remove_object("tnak");
    REQUIRE_FALSE(missing.ok());
    CHECK(missing.error().code == proto::ErrorCode::object_not_found);
    CHECK(missing.error().path == "params.name");
    CHECK(missing.error().hint == "did you mean \"tank\"?");

    CHECK(run.add_object({"ball", proto::ObjectRole::obstacle, proto::SphereDesc{{0.3, 0.1, 0.05}, 0.05}}).ok());
    const auto twice = run.add_object({"ball", proto::ObjectRole::obstacle, proto::SphereDesc{{0.3, 0.1, 0.05}, 0.05}});
    REQUIRE_FALSE(twice.ok());
    CHECK(twice.error().code == proto::ErrorCode::object_exists);
    CHECK_FALSE(run.add_object({"dot", proto::ObjectRole::obstacle, proto::SphereDesc{{0, 0, 0}, 0.0}}).ok());

    CHECK(run.move_object("ball", proto::Vec3{0.2, 0.2, 0.0}, {}).ok());
    CHECK(std::get<proto::SphereDesc>(run.objects()[1].shape).center == proto::Vec3{0.2, 0.2, 0.0});
    CHECK(run.move_object("ball", {}, proto::Vec3{0.1, 0.0, 0.0}).ok());
    CHECK(std::get<proto::SphereDesc>(run.objects()[1].shape).center[0] == Approx(0.3));
}

TEST_CASE("Run.ParametersChangeAllOrNone") {
    auto built = scene::Run::build(small_scene());
    REQUIRE(built.ok());
    scene::Run& run = **built;
    proto::Parameters previous;
    CHECK(run.set_parameters({{"viscosity", 7.0}}, &previous).ok());
    CHECK(std::get<double>(previous.at("viscosity")) == 3.5);
    CHECK(std::get<double>(run.model().parameters().at("viscosity")) == 7.0);
    CHECK_FALSE(run.set_parameters({{"stiffness", 9.0}, {"viscosity", -1.0}}).ok());
    CHECK(std::get<double>(run.model().parameters().at("stiffness")) != 9.0);
}

TEST_CASE("AtRestWatch.RestMustLastAndIsLostByMotion") {
    proto::SceneDesc scene = small_scene();
    scene.parameters["gravity"] = proto::Vec3{0, 0, 0};
    scene.parameters["stiffness"] = 1e-9;  // nothing moves
    scene.parameters["surface_tension"] = 0.0;
    scene.at_rest.duration = 0.1;
    auto built = scene::Run::build(scene);
    REQUIRE(built.ok());
    scene::Run& run = **built;
    server::AtRestWatch watch(run);
    double reported = -1.0;
    for (int k = 0; k < 60 && reported < 0.0; ++k) {
        run.step();
        if (watch.update(run)) reported = run.time();
    }
    // The first step starts the clock; rest is reported within a step of 0.1 s later.
    CHECK(reported >= 0.1);
    CHECK(reported <= 0.1 + 2.5 * run.last_report().dt);
    REQUIRE(run.set_parameters({{"gravity", proto::Vec3{0, -9.82, 0}}}).ok());
    for (int k = 0; k < 8; ++k) run.step();  // 0.07 s: in mid-fall
    CHECK_FALSE(watch.update(run));
}

// A drop in free flight: pair forces cancel, so its mean velocity is the time integral of the scene's accelerations.
TEST_CASE("Run.BodyForceAndFrameMoveTheFluid") {
    proto::SceneDesc scene;
    scene.name = "drop";
    scene.dimensions = 2;
    scene.model = "wcsph";
    scene.spacing = 0.1;
    scene.parameters["gravity"] = proto::Vec3{};
    scene.domain = {{-5, -5}, {5, 5}};
    scene.fluids.push_back({"water", proto::SphereDesc{{0, 0}, 0.5}});
    scene.body_force[0] = std::string("2");
    scene.frame_acceleration = proto::ScalarVec3{0.5, 1.0, 0.0};
    auto run = scene::Run::build(scene);
    if (!run) FAIL(run.error().path << ": " << run.error().message);
    for (int k = 0; k < 5; ++k) REQUIRE_FALSE((*run)->step().fault);
    const solver::Particles& particles = (*run)->particles();
    double sum[2]{};
    for (std::size_t i = 0; i < particles.size(); ++i)
        for (int axis = 0; axis < 2; ++axis) sum[axis] += particles.v[axis][i];
    const double n = static_cast<double>(particles.size());
    // A uniform field leaves the drop as it is: rounding only.
    CHECK(sum[0] / n == Approx(1.5 * (*run)->time()).epsilon(1e-9));
    CHECK(sum[1] / n == Approx(-1.0 * (*run)->time()).epsilon(1e-9));
}
