#include <catch2/catch.hpp>
#include <cmath>

#include "client/convergence_plan.h"

using namespace headrace;
using namespace headrace::client;

namespace {

proto::SceneDesc tank_scene() {
    proto::SceneDesc scene;
    scene.dimensions = 2;
    scene.spacing = 0.1;
    scene.domain = {{-1, -1, 0}, {3, 3, 0}, {}};
    proto::FluidDesc fluid;
    fluid.shape = proto::BoxDesc{{0, 0, 0}, {1, 2, 0}};
    scene.fluids.push_back(fluid);
    scene.probes.push_back({"front", proto::FrontProbe{}, {}, {}});
    return scene;
}

bool is_whole(double cells) {
    return std::abs(cells - std::round(cells)) < 1e-9;
}

proto::ParameterEntry entry(const std::string& name, double value) {
    return {name, value, value, "1", ""};
}

}  // namespace

TEST_CASE("ConvergencePlan.FinerLatticesFillWhatTheCoarsestFills") {
    const double root2 = std::sqrt(2.0);
    // 10 x 20 cells: 14 x 28 and 20 x 40 follow.
    const auto spacings = choose_spacings(tank_scene(), 0.1, root2);
    CHECK(spacings[0] == 0.1);
    CHECK(spacings[1] == Approx(1.0 / 14).epsilon(1e-12));
    CHECK(spacings[2] == Approx(1.0 / 20).epsilon(1e-12));
    // A period counts as well: 40 x 40 cells of 0.1 in the domain.
    proto::SceneDesc periodic = tank_scene();
    periodic.domain.periodic = {true, false, false};
    periodic.fluids[0].shape = proto::BoxDesc{{-1, 0, 0}, {3, 0.5, 0}};
    for (const double spacing : choose_spacings(periodic, 0.1, 1.5)) {
        CAPTURE(spacing);
        CHECK(is_whole(4 / spacing));
        CHECK(is_whole(0.5 / spacing));
    }
}

TEST_CASE("ConvergencePlan.RatioIsKeptWhereNothingFits") {
    proto::SceneDesc scene = tank_scene();
    // 10 x 17 cells have no common divisor: only whole ratios fill both.
    scene.fluids[0].shape = proto::BoxDesc{{0, 0, 0}, {1, 1.7, 0}};
    const auto doubled = choose_spacings(scene, 0.1, 2.0);
    CHECK(doubled[1] == Approx(0.05).epsilon(1e-12));
    CHECK(doubled[2] == Approx(0.025).epsilon(1e-12));
    const auto near = choose_spacings(scene, 0.1, 1.5);
    CHECK(near[1] == Approx(0.1 / 1.5).epsilon(0.09));
    // A length that the coarsest lattice does not fill asks for nothing.
    const auto plain = choose_spacings(scene, 0.0937, 1.5);
    CHECK(plain[1] == 0.0937 / 1.5);
    CHECK(plain[2] == 0.0937 / 2.25);
}

TEST_CASE("ConvergencePlan.RefusesScenesThatDoNotRefine") {
    CHECK(check_refinable(tank_scene()));
    proto::SceneDesc scene = tank_scene();
    scene.probes.clear();
    REQUIRE_FALSE(check_refinable(scene));
    CHECK(check_refinable(scene).error().hint.find("--probe") != std::string::npos);

    scene = tank_scene();
    scene.parameters = {{"support_radius", 0.05}, {"time_step", 0.001}, {"viscosity", 1.0}};
    REQUIRE_FALSE(check_refinable(scene));
    CHECK(check_refinable(scene).error().message == "fixed for one spacing: support_radius, time_step");
    scene.parameters = {{"time_step", 0.0}};  // the model's own choice
    CHECK(check_refinable(scene));

    scene = tank_scene();
    proto::SceneEventDesc event;
    event.step = 10;
    event.action = proto::RemoveObjectAction{"panel"};
    scene.events = {event};
    REQUIRE_FALSE(check_refinable(scene));
    CHECK(check_refinable(scene).error().path == "scene.events[0].step");
    scene.events[0].step.reset();
    scene.events[0].time = 1.0;
    CHECK(check_refinable(scene));
    scene.events[0].action = proto::PauseAction{};
    CHECK_FALSE(check_refinable(scene));
    scene.events[0].action = proto::SetParametersAction{{{"sound_speed", 40.0}}};
    CHECK_FALSE(check_refinable(scene));
}

TEST_CASE("ConvergencePlan.AddsProbes") {
    proto::SceneDesc scene = tank_scene();
    REQUIRE(add_probe(scene, R"(gauge={"level": {"from": [0.1, 0], "to": [0.1, 0.5]}})"));
    REQUIRE(add_probe(scene, R"(often={"kind": {"density": {}}, "interval": 0.001})"));
    REQUIRE(scene.probes.size() == 3);
    CHECK(scene.probes[1].name == "gauge");
    CHECK(std::get<proto::LevelProbe>(scene.probes[1].kind).to == proto::Vec3{0.1, 0.5, 0});
    CHECK(scene.probes[2].interval == 0.001);
    for (const char* word : {"gauge", "=3", "a={", "a=3", R"(a={"levl": {}})", R"(front={"front": {}})"}) {
        CAPTURE(word);
        CHECK_FALSE(add_probe(scene, word));
    }
}

TEST_CASE("ConvergencePlan.VariesTheSoundSpeedAsTheModelTellsIt") {
    const auto accurate = find_sound_speed({entry("viscosity", 1), entry("sound_speed", 20)});
    REQUIRE(accurate);
    CHECK(sound_speed_parameters(**accurate, 2) == proto::Parameters{{"sound_speed", 40.0}});
    // A fixed time step follows the speed, the stiffness is its square.
    const auto soft = find_sound_speed({entry("stiffness", 9), entry("time_step", 0.01)});
    REQUIRE(soft);
    CHECK((*soft)->value == 3);
    CHECK(sound_speed_parameters(**soft, 2) == proto::Parameters{{"stiffness", 36.0}, {"time_step", 0.005}});
    // Unknown, nothing to vary, none at all.
    CHECK_FALSE(find_sound_speed({entry("sound_speed", 0)}));
    CHECK_FALSE(find_sound_speed({entry("stiffness", 0)}));
    const auto none = find_sound_speed({entry("viscosity", 1)});
    REQUIRE(none);
    CHECK_FALSE(*none);
}
