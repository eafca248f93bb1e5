// The plan tells what a step does, what it leaves out and why, and how pairs are summed.
#include <catch2/catch.hpp>
#include <limits>

#include "scenes.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

Stage find_stage(const Scene& scene, const std::string& name) {
    for (const Stage& stage : scene.model->plan(scene.surroundings()))
        if (stage.name == name) return stage;
    FAIL("no stage " << name);
    return {};
}

bool is_skipped(const Scene& scene, const std::string& name) {
    const Stage stage = find_stage(scene, name);
    if (!stage.active) CHECK_FALSE(stage.reason.empty());
    return !stage.active;
}

}  // namespace

TEST_CASE("WcsphPlan.EachTermIsSkippedWithoutItsCoefficient") {
    const std::vector<std::pair<std::string, ParameterMap>> left_out{
        {"viscosity", {{"viscosity", 0.0}}},
        {"surface_tension", {{"surface_tension", 0.0}}},
        {"density_diffusion", {{"density_diffusion", std::string("none")}}},
        {"density_diffusion", {{"density_diffusion_factor", 0.0}}},
        {"artificial_viscosity", {{"artificial_viscosity", 0.0}}},
        {"artificial_viscosity", {{"viscosity", 1e3}}},  // which does all that it would
        {"shifting", {{"shifting", false}}},
        {"shifting", {{"shifting_factor", 0.0}}},
        {"shifting", {{"shifting_limit", 0.0}}}};
    for (const auto& [stage, without] : left_out) {
        INFO(stage << " by " << without.begin()->first);
        Scene scene = make_drop(2, 10);
        scene.parameters.insert({{"viscosity", 0.1}, {"surface_tension", 0.1}});
        scene.start();
        CHECK_FALSE(is_skipped(scene, stage));
        for (const auto& [name, value] : without) scene.parameters.insert_or_assign(name, value);
        scene.start();
        CHECK(is_skipped(scene, stage));
    }
}

TEST_CASE("WcsphPlan.WhatTheSceneDoesNotHaveIsSkipped") {
    Scene free = make_drop(2, 10);
    free.start();
    for (const char* stage : {"walls", "wall_motion", "body_force", "energies"}) CHECK(is_skipped(free, stage));
    free.body_force = [](double, const Particles&, VectorField&) {};
    free.start();
    CHECK_FALSE(is_skipped(free, "body_force"));
    free.model->follow_energies(true);
    CHECK_FALSE(is_skipped(free, "energies"));

    Scene tank = make_tank(2, 10);
    tank.start();
    CHECK_FALSE(is_skipped(tank, "walls"));
    CHECK(is_skipped(tank, "wall_motion"));
}

TEST_CASE("WcsphPlan.OnlyWhatIsDoneTakesTime") {
    Scene scene = make_tank(2, 10);
    scene.parameters.insert_or_assign("viscosity", 0.1);
    scene.start();
    scene.steps(3);
    double in_steps = 0.0;
    for (const Stage& stage : scene.model->plan(scene.surroundings())) {
        INFO(stage.name);
        if (!stage.active) CHECK(stage.seconds == 0.0);
        in_steps += stage.seconds;
    }
    CHECK(find_stage(scene, "viscosity").seconds > 0.0);
    CHECK(find_stage(scene, "pressure_force").seconds > 0.0);
    CHECK(find_stage(scene, "walls").seconds > 0.0);
    CHECK(in_steps > 0.0);
}

// A coefficient of 0 must not change a bit either: density diffusion adds nothing, shifting moves nothing.
TEST_CASE("WcsphPlan.ACoefficientOfZeroIsTheTermLeftOut") {
    const auto hash_with = [](const std::string& name, const ParameterValue& value) {
        Scene scene = make_drop(2, 16, 0.1);
        scene.parameters.insert_or_assign(name, value);
        scene.start();
        scene.steps(5);
        return compute_state_hash(scene.particles);
    };
    CHECK(hash_with("density_diffusion_factor", 0.0) == hash_with("density_diffusion", std::string("none")));
    CHECK(hash_with("shifting_factor", 0.0) == hash_with("shifting", false));
    CHECK(hash_with("shifting_factor", 1.0) != hash_with("shifting", false));
}

TEST_CASE("WcsphPlan.StrategyNamesThePrecisionOfThePairSums") {
    Scene scene = make_drop(2, 10);
    scene.start();  // in double, as these scenes are
    CHECK(scene.model->strategy().find("double precision") != std::string::npos);
    scene.parameters.insert_or_assign("precision", std::string("single"));
    scene.start();
    CHECK(scene.model->strategy().find("single precision") != std::string::npos);
}
