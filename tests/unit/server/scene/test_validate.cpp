// What the scene language refuses when a scene is loaded or an object added, with its path and a hint.
#include <catch2/catch.hpp>

#include "server/scene/run.h"
#include "server/scene/validate.h"

using namespace headrace;
using proto::Scalar;
using proto::ScalarVec3;

namespace {

// 5 x 5 x 5 particles between 0 and 0.5 in a domain of -1 to 1.
proto::SceneDesc cube(int dimensions = 3) {
    proto::SceneDesc scene;
    scene.name = "cube";
    scene.dimensions = dimensions;
    scene.spacing = 0.1;
    scene.domain = {{-1, -1, -1}, {1, 1, 1}};
    scene.fluids.push_back({"water", proto::BoxDesc{{0, 0, 0}, {0.5, 0.5, 0.5}}});
    return scene;
}

// 0.2 m of water on a floor, without ends along x.
proto::SceneDesc channel() {
    proto::SceneDesc scene = cube(2);
    scene.model = "wcsph";
    scene.domain = {{0, -1, 0}, {1.2, 1, 0}, {true, false, false}};
    scene.fluids[0].shape = proto::BoxDesc{{0, 0, 0}, {1.2, 0.2, 0}};
    scene.objects.push_back({"floor", proto::ObjectRole::obstacle, proto::PlaneDesc{{0, 0, 0}, {0, 1, 0}}});
    return scene;
}

std::string refused(const proto::Status& status) {
    if (status.ok()) return "taken";
    CHECK(status.error().code == proto::ErrorCode::scene_invalid);
    CHECK_FALSE(status.error().message.empty());
    CHECK_FALSE(status.error().hint.empty());
    return status.error().path;
}

std::string refused(const proto::SceneDesc& scene) {
    scene::BuildControl control;
    return refused(scene::validate(scene, control));
}

// Of the whole build, the model's own refusals included.
std::string refused_by_model(const proto::SceneDesc& scene) {
    const auto run = scene::Run::build(scene);
    return run.ok() ? "taken" : refused(proto::Status(run.error()));
}

}  // namespace

TEST_CASE("Validate.FluidsHaveAnEnd") {
    proto::SceneDesc scene = cube();
    const proto::PlaneDesc slope{{0, 0.3, 0}, {1, 1, 0}};
    scene.fluids[0].shape = slope;
    CHECK(refused(scene) == "scene.fluids[0].shape");
    scene.fluids[0].shape = proto::IntersectionDesc{{proto::BoxDesc{{0, 0, 0}, {0.5, 0.5, 0.5}}, slope}};
    CHECK(refused(scene) == "taken");
    scene.fluids[0].shape = proto::DifferenceDesc{{slope, proto::BoxDesc{{0, 0, 0}, {0.5, 0.5, 0.5}}}};
    CHECK(refused(scene) == "scene.fluids[0].shape");
    scene.fluids[0].shape =
        proto::DifferenceDesc{{proto::BoxDesc{{0, 0, 0}, {0.5, 0.5, 0.5}}, proto::BoxDesc{{-1, -1, -1}, {1, 1, 1}}}};
    CHECK(refused(scene) == "scene.fluids[0].shape");  // nothing is left
}

TEST_CASE("Validate.ShapesAreCheckedAtAnyDepth") {
    proto::SceneDesc scene = cube();
    const proto::BoxDesc box{{0, 0, 0}, {0.5, 0.5, 0.5}};
    scene.fluids[0].shape = proto::DifferenceDesc{{box, proto::SphereDesc{{0, 0, 0}, -1.0}}};
    CHECK(refused(scene) == "scene.fluids[0].shape.difference.of[1].sphere.radius");
    scene.fluids[0].shape = proto::IntersectionDesc{{box}};
    CHECK(refused(scene) == "scene.fluids[0].shape.intersection.of");
    scene = cube(2);
    scene.fluids[0].shape = proto::CylinderDesc{{0, 0, 0}, {0, 1, 0}, 0.5};
    CHECK(refused(scene) == "scene.fluids[0].shape.cylinder");
    scene.fluids[0].shape = proto::IntersectionDesc{{box, proto::PlaneDesc{{0, 0, 0}, {0, 0, 1}}}};
    CHECK(refused(scene) == "scene.fluids[0].shape.intersection.of[1].plane.normal");
}

TEST_CASE("Validate.FluidStandsOnTheRightSideOfEveryPrimitive") {
    proto::SceneDesc scene = cube();
    scene.objects.push_back({"wall", proto::ObjectRole::obstacle});
    const auto with = [&](const proto::ShapeDesc& shape, proto::ObjectRole role = proto::ObjectRole::obstacle) {
        scene.objects[0].shape = shape;
        scene.objects[0].role = role;
        return refused(scene);
    };
    using Role = proto::ObjectRole;
    CHECK(with(proto::PlaneDesc{{0, 0, 0}, {0, 1, 0}}) == "taken");
    CHECK(with(proto::PlaneDesc{{0, 0, 0}, {0, -1, 0}}) == "scene.fluids[0].shape");
    CHECK(with(proto::PlaneDesc{{0, 0.1, 0}, {0, 1, 0}}, Role::container) == "scene.fluids[0].shape");
    CHECK(with(proto::CylinderDesc{{0.7, 0, 0}, {0.7, 1, 0}, 0.2}) == "taken");
    CHECK(with(proto::CylinderDesc{{0.6, 0, 0.3}, {0.6, 1, 0.3}, 0.2}) == "scene.fluids[0].shape");
    CHECK(with(proto::CylinderDesc{{0.25, 0, 0.25}, {0.25, 0.5, 0.25}, 0.4}, Role::container) == "taken");
    CHECK(with(proto::CylinderDesc{{0.25, 0, 0.25}, {0.25, 0.5, 0.25}, 0.2}, Role::container) ==
          "scene.fluids[0].shape");
    CHECK(with(proto::DifferenceDesc{{proto::SphereDesc{{0, 0, 0}, 1}, proto::SphereDesc{{0, 0, 0}, 0.5}}}) ==
          "scene.objects[0].shape");
    // Drawn beside the fluid, standing in it at t = 0.
    scene.objects[0].motion.emplace();
    scene.objects[0].motion->displacement = ScalarVec3{std::string("-0.3*cos(t)"), 0.0, 0.0};
    CHECK(with(proto::BoxDesc{{0.6, 0, 0}, {0.7, 1, 1}}) == "scene.fluids[0].shape");
    CHECK(with(proto::BoxDesc{{0.85, 0, 0}, {0.95, 1, 1}}) == "taken");
}

TEST_CASE("Validate.ExpressionsAreCompiledAtLoad") {
    proto::SceneDesc scene = cube();
    scene.fluids[0].velocity[2] = Scalar(std::string("sin(t)"));  // at the start there is no t
    CHECK(refused(scene) == "scene.fluids[0].velocity[2]");
    scene.fluids[0].velocity[2] = 0.0;
    scene.fluids[0].pressure = Scalar(std::string("x +"));
    CHECK(refused(scene) == "scene.fluids[0].pressure");
    scene.fluids[0].pressure.reset();
    scene.body_force[0] = Scalar(std::string("sin(w)"));
    CHECK(refused(scene) == "scene.body_force[0]");
    scene.body_force[0] = 0.0;
    scene.frame_acceleration = proto::TableDesc{{{0, 0, 0, 0}, {0, 1, 1, 1}}};
    CHECK(refused(scene) == "scene.frame_acceleration.table[1][0]");
    scene.frame_acceleration.reset();
    scene.objects.push_back({"wall", proto::ObjectRole::obstacle, proto::BoxDesc{{0.6, 0, 0}, {0.7, 1, 1}}});
    scene.objects[0].surface_velocity = ScalarVec3{std::string("x"), 0.0, 0.0};
    CHECK(refused(scene) == "scene.objects[0].surface_velocity[0]");
    CHECK(refused(cube()) == "taken");
}

TEST_CASE("Validate.StartsMakeSense") {
    proto::SceneDesc scene = cube();
    scene.fluids[0].hydrostatic = true;
    CHECK(refused(scene) == "taken");
    scene.fluids[0].pressure = 5.0;
    CHECK(refused(scene) == "scene.fluids[0].hydrostatic");
    scene.fluids[0].pressure.reset();
    scene.fluids[0].start.jitter = GENERATE(-0.1, 0.6, std::numeric_limits<double>::quiet_NaN());
    CHECK(refused(scene) == "scene.fluids[0].start.jitter");
}

TEST_CASE("Validate.AFluidGoesOnEvenlyOverAPeriod") {
    proto::SceneDesc scene = cube(2);
    scene.domain = {{0, 0, 0}, {0.5, 0.5, 0}};
    scene.domain.periodic = {true, true, false};
    CHECK(refused(scene) == "taken");
    scene.fluids[0].shape = proto::BoxDesc{{0, 0, 0}, {0.3, 0.5, 0}};
    CHECK(refused(scene) == "taken");  // does not reach both ends
    scene.domain.max[0] = 0.54;
    scene.fluids[0].shape = proto::BoxDesc{{0, 0, 0}, {0.54, 0.5, 0}};
    CHECK(refused(scene) == "scene.fluids[0].shape");
    scene.domain.periodic[0] = false;
    CHECK(refused(scene) == "taken");
    scene.fluids[0].shape = proto::BoxDesc{{0, 0, 0}, {0.9, 0.5, 0}};
    scene.domain.periodic[0] = true;
    scene.domain.max[0] = 0.5;
    CHECK(refused(scene) == "scene.fluids[0].shape");  // out of the domain
    scene = cube(2);
    scene.domain.periodic[2] = true;
    CHECK(refused(scene) == "scene.domain.periodic[2]");
}

TEST_CASE("Validate.TheSpacingToTakeInsteadCanBeCopied") {
    proto::SceneDesc scene = cube(2);
    scene.spacing = 2.1e-4;
    scene.domain = {{0, 0, 0}, {0.2, 0.5, 0}, {true, false, false}};
    scene.fluids[0].shape = proto::BoxDesc{{0, 0, 0}, {0.2, 0.01, 0}};
    scene::BuildControl control;
    const std::string hint = scene::validate(scene, control).error().hint;
    scene.spacing = std::stod(hint.substr(hint.find("scene.spacing ") + 14));
    CHECK(scene.spacing == Approx(2.1e-4).epsilon(1e-3));
    CHECK(refused(scene) == "taken");
}

TEST_CASE("Validate.WallsWithoutEndsDoNotTurnOutOfTheirAxis") {
    proto::SceneDesc scene = channel();
    scene.objects[0].motion.emplace();
    scene.objects[0].motion->displacement = ScalarVec3{std::string("0.01*sin(t)"), 0.0, 0.0};
    CHECK(refused_by_model(scene) == "taken");
    scene.objects[0].motion->angle = Scalar(std::string("0.1*sin(t)"));
    CHECK(refused_by_model(scene) == "scene.objects[0].motion.angle");
    scene.objects[0].shape = proto::BoxDesc{{0, -0.5, 0}, {1.2, 0, 0}};  // as long as the period
    CHECK(refused_by_model(scene) == "scene.objects[0].motion.angle");
    scene.objects[0].shape = proto::BoxDesc{{0.1, -0.5, 0}, {0.5, -0.3, 0}};
    CHECK(refused_by_model(scene) == "taken");

    scene = cube(3);
    scene.model = "wcsph";
    scene.domain = {{0, -1, 0}, {1.2, 1, 1.2}, {true, false, true}};
    scene.fluids[0].shape = proto::BoxDesc{{0, 0, 0}, {1.2, 0.2, 1.2}};
    scene.objects.push_back(
        {"roller", proto::ObjectRole::obstacle, proto::CylinderDesc{{0, -0.5, 0.2}, {1.2, -0.5, 0.2}, 0.3}});
    scene.objects[0].motion.emplace();
    scene.objects[0].motion->angle = Scalar(std::string("t"));
    scene.objects[0].motion->pivot = {0, -0.5, 0.2};
    scene.objects[0].motion->axis = {2, 0, 0};
    CHECK(refused_by_model(scene) == "taken");  // about its own axis
    scene.objects[0].motion->axis = {0, 1, 0};
    CHECK(refused_by_model(scene) == "scene.objects[0].motion.angle");
}

TEST_CASE("Validate.ASceneWithoutAFirstTimeStepIsRefused") {
    proto::SceneDesc scene = channel();
    scene.fluids[0].velocity[0] = 1e300;
    CHECK(refused_by_model(scene) == "scene");
    scene.fluids[0].velocity[0] = 0.0;
    scene.objects[0].surface_velocity = ScalarVec3{1e300, 0.0, 0.0};
    CHECK(refused_by_model(scene) == "scene");
}

// What the next step could not do is refused at once, and the run goes on as it was.
TEST_CASE("Validate.MoreThanARunCanHoldIsRefusedBeforeTheStep") {
    auto run = scene::Run::build(channel());
    REQUIRE(run.ok());
    // Walls at rest are cut to the domain, moving ones come whole: 10^9 spacings of surface.
    proto::ObjectDesc object{"ship", proto::ObjectRole::obstacle, proto::BoxDesc{{-1e8, -1e8, 0}, {1e8, -0.5, 0}}};
    object.motion.emplace();
    object.motion->displacement = ScalarVec3{0.0, std::string("0.01*sin(t)"), 0.0};
    proto::Status status = (*run)->add_object(object);
    REQUIRE_FALSE(status.ok());
    CHECK(status.error().code == proto::ErrorCode::limit_exceeded);
    CHECK(status.error().path == "params.object");
    CHECK((*run)->objects().size() == 1);

    // Three cells of 6.5 spacings do not fit into a period of twelve.
    status = (*run)->set_parameters({{"support_over_spacing", 6.0}});
    REQUIRE_FALSE(status.ok());
    CHECK(status.error().code == proto::ErrorCode::invalid_params);
    CHECK(status.error().path == "params.parameters");
    CHECK(std::get<double>((*run)->model().parameters().at("support_over_spacing")) != 6.0);
    CHECK((*run)->set_parameters({{"viscosity", 1.0}}));
    CHECK_FALSE((*run)->step().fault);
}

TEST_CASE("Validate.TheModelMayRefuse") {
    proto::SceneDesc scene = cube();
    CHECK(refused_by_model(scene) == "taken");
    scene.objects.push_back({"floor", proto::ObjectRole::obstacle, proto::PlaneDesc{{0, 0, 0}, {0, 1, 0}}});
    CHECK(refused_by_model(scene) == "scene.objects[0]");  // the thesis knows boxes and spheres
    scene.objects[0].shape = proto::BoxDesc{{-1, -1, -1}, {1, 0, 1}};
    CHECK(refused_by_model(scene) == "taken");
    scene.objects[0].motion.emplace();
    CHECK(refused_by_model(scene) == "scene.objects[0]");
    scene = cube();
    scene.domain.periodic[0] = true;
    CHECK(refused_by_model(scene) == "scene.domain");
    scene = cube();
    scene.body_force[1] = Scalar(std::string("x"));
    CHECK(refused_by_model(scene) == "scene.body_force");
    scene.frame_acceleration = ScalarVec3{std::string("t"), 0.0, 0.0};
    CHECK(refused_by_model(scene) == "scene.frame_acceleration");
}

TEST_CASE("Validate.AddedObjectsAreCheckedLikeTheScenes") {
    auto run = scene::Run::build(cube());
    REQUIRE(run.ok());
    const auto why = [&](const proto::ObjectDesc& object) {
        const proto::Status status = (*run)->add_object(object);
        if (status.ok()) return std::string("taken");
        CHECK(status.error().code == proto::ErrorCode::invalid_params);
        CHECK_FALSE(status.error().hint.empty());
        return status.error().path;
    };
    proto::ObjectDesc object{"paddle", proto::ObjectRole::obstacle, proto::BoxDesc{{0.6, 0, 0}, {0.7, 1, 1}}};
    object.surface_velocity = ScalarVec3{std::string("oops"), 0.0, 0.0};
    CHECK(why(object) == "params.object.surface_velocity[0]");
    object.surface_velocity.reset();
    object.shape = proto::CylinderDesc{{0, 0, 0}, {0, 1, 0}, 0.1};
    CHECK(why(object) == "params.object");  // the thesis model knows none
    object.shape = proto::IntersectionDesc{};
    CHECK(why(object) == "params.object.shape");
    CHECK((*run)->objects().empty());
}
