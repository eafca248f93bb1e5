#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "scenes.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

EnergyBudget budget_of(const Scene& scene) {
    const auto budget = scene.model->energies(scene.particles, scene.surroundings());
    REQUIRE(budget);
    return *budget;
}

// Vortices of the Taylor-Green flow, 1 m/s.
void set_vortices(Particles& particles) {
    constexpr double k = 2.0 * std::numbers::pi;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double x = k * particles.x[0][i], y = k * particles.x[1][i];
        particles.v[0][i] = -std::cos(x) * std::sin(y);
        particles.v[1][i] = std::sin(x) * std::cos(y);
        particles.p[i] = -250.0 * (std::cos(2.0 * x) + std::cos(2.0 * y));
    }
}

}  // namespace

TEST_CASE("WcsphEnergies.FreeFallTurnsPotentialIntoKinetic") {
    Scene scene = make_drop(2, 12);
    for (int k = 0; k < 2; ++k) scene.particles.v[k].assign(scene.particles.size(), 0.3);
    scene.parameters["gravity"] = Vec3{1.0, -9.0, 0.0};
    scene.parameters["shifting"] = false;
    scene.start();
    scene.model->follow_energies(true);
    const EnergyBudget before = budget_of(scene);
    scene.steps(20);
    const EnergyBudget after = budget_of(scene);
    const double gained = after.kinetic - before.kinetic;
    CHECK(gained > 0.1 * before.kinetic);
    // Round-off of 20 steps; fluid that falls as one does not stir, but for rounding.
    CHECK(std::abs(after.potential - before.potential + gained) < 1e-12 * after.kinetic);
    CHECK(std::abs(after.dissipated) < 1e-12 * after.kinetic);
    CHECK(after.work == 0.0);
    CHECK(std::abs(after.balance) < 1e-12 * after.kinetic);
    CHECK(after.internal < 1e-12 * after.kinetic);
}

TEST_CASE("WcsphEnergies.FollowingChangesNoBitOfTheRun") {
    const auto run = [](bool follows) {
        Scene scene = make_tank(2, 16);
        displace_randomly(scene.particles, 0.1 * scene.dx, 3);
        scene.parameters["artificial_viscosity"] = 0.05;
        scene.parameters["viscosity"] = 1.0;
        scene.start();
        scene.steps(3);
        scene.model->follow_energies(follows);
        scene.steps(20);
        return compute_state_hash(scene.particles);
    };
    CHECK(run(true) == run(false));
}

TEST_CASE("WcsphEnergies.ViscosityDissipatesWhatMotionLoses") {
    const char* form = GENERATE("morris", "monaghan_gingold");
    Scene scene = make_periodic_square(20);
    set_vortices(scene.particles);
    scene.parameters["viscosity"] = 10.0;  // Re 100
    scene.parameters["viscosity_form"] = std::string(form);
    scene.parameters["pressure_gradient"] = std::string("adjoint");
    scene.parameters["density_diffusion"] = std::string("none");
    scene.parameters["artificial_viscosity"] = 0.0;
    scene.parameters["shifting"] = false;
    scene.start();
    scene.model->follow_energies(true);
    const EnergyBudget start = budget_of(scene);
    double before = 0.0;
    while (scene.time < 0.12) {
        REQUIRE_FALSE(scene.step().fault);
        const EnergyBudget now = budget_of(scene);
        CHECK(now.dissipated > before);
        before = now.dissipated;
    }
    const EnergyBudget end = budget_of(scene);
    CHECK(end.dissipated > 0.1 * start.kinetic);
    CHECK(end.work == 0.0);
    // The adjoint form loses nothing but errors in time: second order in the acoustic step.
    CHECK(std::abs(end.balance) < 2e-3 * start.kinetic);
    CHECK(end.dissipated == Approx(start.kinetic + start.internal - end.kinetic - end.internal + end.balance));
}

TEST_CASE("WcsphEnergies.GravityAlongAPeriodIsWork") {
    Scene scene = make_periodic_square(12);
    scene.parameters["gravity"] = Vec3{2.0, 0.0, 0.0};
    scene.parameters["shifting"] = false;
    scene.start();
    scene.model->follow_energies(true);
    while (scene.time < 1.5) REQUIRE_FALSE(scene.step().fault);  // far enough to pass the periodic end
    const EnergyBudget end = budget_of(scene);
    CHECK(end.potential == 0.0);
    // m (g t)^2/2, exact for constant acceleration but for round-off.
    CHECK(end.kinetic == Approx(0.5 * 1000.0 * std::pow(2.0 * scene.time, 2)).epsilon(1e-10));
    CHECK(end.work == Approx(end.kinetic).epsilon(1e-10));
    CHECK(std::abs(end.balance) < 1e-9 * end.kinetic);
}

TEST_CASE("WcsphEnergies.BodyForceIsWork") {
    Scene scene = make_drop(2, 16);
    for (int k = 0; k < 2; ++k) std::fill(scene.particles.v[k].begin(), scene.particles.v[k].end(), 0.0);
    scene.body_force = [](double, const Particles& p, VectorField& a) {
        for (std::size_t i = 0; i < p.size(); ++i) a[0][i] += 3.0;
    };
    scene.parameters["shifting"] = false;
    scene.start();
    scene.model->follow_energies(true);
    scene.steps(10);
    const EnergyBudget end = budget_of(scene);
    CHECK(end.kinetic > 0.0);
    CHECK(end.work == Approx(end.kinetic).epsilon(1e-10));
}

TEST_CASE("WcsphEnergies.SurfaceTensionIsWork") {
    // A stretched drop at rest pulls itself together.
    Scene scene = make_drop(2, 20);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        scene.particles.x[0][i] *= 1.25;
        scene.particles.x[1][i] /= 1.25;
        scene.particles.v[0][i] = scene.particles.v[1][i] = 0.0;
        scene.particles.p[i] = 500.0;  // sigma/R
    }
    scene.parameters["surface_tension"] = 500.0;
    scene.parameters["artificial_viscosity"] = 0.0;
    scene.parameters["cfl"] = 0.2;  // short: the stretched lattice rings
    scene.parameters["advective_cfl"] = 0.1;
    scene.parameters["shifting"] = false;
    scene.start();
    scene.model->follow_energies(true);
    while (scene.time < 0.2) REQUIRE_FALSE(scene.step().fault);
    const EnergyBudget end = budget_of(scene);
    CAPTURE(end.kinetic, end.internal, end.dissipated, end.work);
    CHECK(end.kinetic > 0.1 * end.work);
    // Errors in time, of the surface's force above all: second order in the step, a few hundredths at these.
    CHECK(std::abs(end.balance) < 0.05 * end.work);
}

TEST_CASE("WcsphEnergies.DissipativeTermsAreCounted") {
    // Each alone on a stirred drop: it takes energy, and the account closes as well as without it.
    const std::string term = GENERATE("none", "artificial_viscosity", "density_diffusion");
    INFO(term);
    Scene scene = make_drop(2, 24, 0.15);
    scene.parameters["density_diffusion"] = std::string(term == "density_diffusion" ? "antuono" : "none");
    scene.parameters["artificial_viscosity"] = term == "artificial_viscosity" ? 0.1 : 0.0;
    scene.parameters["artificial_viscosity_form"] = std::string("monaghan");
    scene.parameters["shifting"] = false;
    scene.parameters["tension_control"] = false;
    scene.parameters["surface_tension"] = 0.0;
    scene.start();
    scene.model->follow_energies(true);
    const EnergyBudget start = budget_of(scene);
    for (int k = 0; k < 60; ++k) scene.step();
    const EnergyBudget end = budget_of(scene);
    const double scale = start.kinetic + start.internal;
    if (term == "none") {
        CHECK(end.dissipated == 0.0);
    } else {
        CHECK(end.dissipated > 1e-4 * scale);
    }
    CAPTURE(end.dissipated / scale, end.balance / scale);
    // Fixed corrections during a step and errors in time: second order in the step.
    CHECK(std::abs(end.balance) < 5e-3 * scale);
}

TEST_CASE("WcsphEnergies.SloshingInAClosedBoxBalances") {
    Scene scene = make_tank(2, 32);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        // the first sloshing mode of a tank 1 m wide
        constexpr double k = std::numbers::pi;
        const double x = scene.particles.x[0][i], y = scene.particles.x[1][i];
        const double scale = 0.3 / std::sinh(0.5 * k);
        scene.particles.v[0][i] = scale * std::cosh(k * y) * std::sin(k * x);
        scene.particles.v[1][i] = -scale * std::sinh(k * y) * std::cos(k * x);
    }
    scene.start();
    scene.model->follow_energies(true);
    const EnergyBudget start = budget_of(scene);
    double worst = 0.0;
    while (scene.time < 1.2) {  // a period is 1.18 s
        REQUIRE_FALSE(scene.step().fault);
        worst = std::max(worst, std::abs(budget_of(scene).balance));
    }
    const EnergyBudget end = budget_of(scene);
    CAPTURE(worst / start.kinetic, end.dissipated / start.kinetic, end.kinetic / start.kinetic);
    CHECK(end.work == 0.0);
    CHECK(worst < 0.05 * start.kinetic);
}

TEST_CASE("WcsphEnergies.MovingLidWorksAgainstViscosity") {
    // Walls of a channel, the upper one moving along itself: what it puts in is kinetic or dissipated.
    Scene scene = make_periodic_square(16);
    scene.domain.periodic[1] = false;
    scene.domain.min[1] = -0.5;
    scene.domain.max[1] = 1.5;
    CollisionObject floor{"floor", Role::obstacle, Plane{{0, 0, 0}, {0, 1, 0}}}, lid = floor;
    lid.name = "lid";
    lid.shape = Plane{{0, 1, 0}, {0, -1, 0}};
    lid.motion = [](double) {
        RigidState state;
        state.surface_velocity = {1.0, 0.0, 0.0};
        return state;
    };
    scene.objects = {floor, lid};
    scene.parameters["wall_slip"] = std::string("no_slip");
    scene.parameters["viscosity"] = 50.0;
    scene.start();
    scene.model->follow_energies(true);
    double impulse = 0.0;
    while (scene.time < 1.0) {
        const StepReport report = scene.step();
        REQUIRE_FALSE(report.fault);
        impulse += report.dt * scene.model->object_loads(scene.particles, scene.surroundings())[1].force[0];
    }
    const EnergyBudget end = budget_of(scene);
    CAPTURE(end.work, end.kinetic, end.dissipated, end.balance);
    CHECK(end.work > 0.0);
    CHECK(end.dissipated > 0.1 * end.work);
    CHECK(end.kinetic + end.internal + end.dissipated == Approx(end.work).epsilon(0.02));
    // The lid moves at 1 m/s: its work is the impulse it gives, evaluated at the steps' ends instead of starts.
    CHECK(-impulse == Approx(end.work).epsilon(0.1));
}

TEST_CASE("WcsphEnergies.AccountBeginsAnewWithTheParameters") {
    Scene scene = make_drop(2, 12);
    scene.parameters["viscosity"] = 10.0;
    scene.start();
    CHECK(budget_of(scene).dissipated == 0.0);  // nobody follows
    scene.steps(3);
    CHECK(budget_of(scene).dissipated == 0.0);
    scene.model->follow_energies(true);
    scene.steps(3);
    CHECK(budget_of(scene).dissipated > 0.0);
    CHECK_FALSE(scene.model->set_parameters({{"viscosity", 0.0}}));
    CHECK(budget_of(scene).dissipated == 0.0);
    CHECK(budget_of(scene).balance == 0.0);
    scene.model->follow_energies(false);
    CHECK(budget_of(scene).kinetic == Approx(kinetic_energy(scene.particles)));
}
