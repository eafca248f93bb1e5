#include <catch2/catch.hpp>
#include <cmath>

#include "../fixtures.h"
#include "server/solver/models/registry.h"
#include "server/solver/models/thesis_parameters.h"

using namespace headrace::solver;
using headrace::solver::testing::kThesisSpacing;

namespace {

bool is_refused(const char* name, ParameterValue value) {
    const auto error = check_parameters(thesis_parameter_table(3, kThesisSpacing), {{name, std::move(value)}});
    return error && error->name == name && !error->unknown && !error->message.empty() && !error->hint.empty();
}

}  // namespace

TEST_CASE("ThesisParameters.DefaultsAreTheThesisTables") {
    const ThesisParameters p = make_thesis_parameters(3, kThesisSpacing, {});
    // 1e-14: cube root and cube
    CHECK(p.time_step == Approx(0.01).epsilon(1e-14));
    CHECK(p.support_radius == Approx(0.0457).epsilon(1e-14));
    CHECK(p.particle_mass == Approx(0.02).epsilon(1e-14));
    CHECK(p.surface_tension_threshold == Approx(7.065).epsilon(1e-14));
    CHECK(p.gravity == Vec3{0.0, -9.82, 0.0});
    CHECK(p.rest_density == 998.29);
    CHECK(p.viscosity == 3.5);
    CHECK(p.surface_tension == 0.0728);
    CHECK(p.stiffness == 3.0);
    CHECK(p.restitution == 0.0);
    CHECK(p.pressure_form == PressureForm::mean);
    CHECK(p.separate_coincident);
}

TEST_CASE("ThesisParameters.FollowTheSpacing") {
    const ThesisParameters p = make_thesis_parameters(3, kThesisSpacing / 2.0, {});
    CHECK(p.support_radius == Approx(0.0457 / 2.0));
    CHECK(p.time_step == Approx(0.005));
    CHECK(p.particle_mass == Approx(0.02 / 8.0));
    CHECK(p.surface_tension_threshold == Approx(2.0 * 7.065));
    const ThesisParameters flat = make_thesis_parameters(2, 0.01, {});
    CHECK(flat.support_radius == Approx(0.025));
    CHECK(flat.particle_mass == Approx(0.099829));
    CHECK(flat.time_step == Approx(0.01 * 0.025 / 0.0457));
}

TEST_CASE("ThesisParameters.DerivedOnesFollowTheOverrides") {
    const ThesisParameters wide = make_thesis_parameters(3, kThesisSpacing, {{"support_radius", 0.0914}});
    CHECK(wide.time_step == Approx(0.02));
    CHECK(wide.surface_tension_threshold == Approx(7.065 / 2.0));
    CHECK(wide.particle_mass == Approx(0.02));
    const ThesisParameters light = make_thesis_parameters(3, kThesisSpacing, {{"rest_density", 998.29 / 2.0}});
    CHECK(light.particle_mass == Approx(0.01));
    const ThesisParameters fixed = make_thesis_parameters(3, kThesisSpacing,
                                                          {{"support_radius", 0.0914},
                                                           {"time_step", 0.003},
                                                           {"surface_tension_threshold", 5.0},
                                                           {"rest_density", 500.0},
                                                           {"particle_mass", 0.07}});
    CHECK(fixed.time_step == 0.003);
    CHECK(fixed.surface_tension_threshold == 5.0);
    CHECK(fixed.particle_mass == 0.07);
}

TEST_CASE("ThesisParameters.ImpossibleValuesAreRefused") {
    CHECK(is_refused("gravity", Vec3{0.0, std::nan(""), 0.0}));
    CHECK(is_refused("time_step", 0.0));
    CHECK(is_refused("time_step", -0.01));
    CHECK(is_refused("rest_density", 0.0));
    CHECK(is_refused("particle_mass", -1.0));
    CHECK(is_refused("viscosity", -0.1));
    CHECK(is_refused("surface_tension", -0.1));
    CHECK(is_refused("surface_tension_threshold", -1.0));
    CHECK(is_refused("stiffness", -3.0));
    CHECK(is_refused("restitution", -0.1));
    CHECK(is_refused("restitution", 1.1));
    CHECK(is_refused("support_radius", 0.0));
    CHECK(is_refused("support_radius", 21.0 * kThesisSpacing));
    CHECK(is_refused("pressure_form", std::string("meen")));
    CHECK(is_refused("separate_coincident", 1.0));
    CHECK(check_parameters(thesis_parameter_table(3, 0.02), {{"stiffnes", 1.0}})->unknown);
}

TEST_CASE("ThesisParameters.TableAndMapListTheSameNames") {
    const auto table = thesis_parameter_table(3, kThesisSpacing);
    const auto map = to_parameter_map(make_thesis_parameters(3, kThesisSpacing, {}));
    CHECK(table.size() == map.size());
    for (const ParameterInfo& info : table) {
        REQUIRE(map.count(info.name) == 1);
        CHECK(map.at(info.name) == info.default_value);
    }
    CHECK_FALSE(check_parameters(table, map));
}

TEST_CASE("Registry.KnowsTheThesisModel") {
    CHECK(model_names() == std::vector<std::string>{"thesis", "wcsph"});
    CHECK(make_model("thesis", 3, kThesisSpacing, {})->name() == "thesis");
    CHECK(model_parameter_table("thesis", 2, 0.01).size() == thesis_parameter_table(2, 0.01).size());
}
