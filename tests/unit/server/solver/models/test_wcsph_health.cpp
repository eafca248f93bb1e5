// The criteria by which a wcsph run stops itself, and what it does about coincident particles.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "server/solver/faults.h"
#include "server/solver/models/wcsph/coincident.h"
#include "server/solver/models/wcsph/health.h"

using namespace headrace::solver;

namespace {

// Three particles in a row, at rest.
Particles three_particles() {
    Particles particles;
    particles.dimensions = 2;
    particles.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
        particles.id[i] = static_cast<Index>(10 + i);
        particles.x[0][i] = 0.1 * static_cast<double>(i);
    }
    return particles;
}

const RunLimits kLimits{20.0, 1e-3, 5e-3, "acoustic", 0.6, 0.6, 0.0, true, false};

std::optional<Fault> check(const Particles& particles, const std::vector<double>& delta,
                           const RunLimits& limits = kLimits) {
    return check_health(particles, find_extremes(particles, delta), limits);
}

}  // namespace

TEST_CASE("WcsphHealth.SoundStatesHaveNoFault") {
    Particles particles = three_particles();
    particles.v[0][1] = 1.99 * kLimits.sound_speed;
    CHECK_FALSE(check(particles, {0.49, -0.49, 0.0}).has_value());
}

TEST_CASE("WcsphHealth.DensityNamesTheWorstParticle") {
    const Particles particles = three_particles();
    for (const double deviation : {0.51, -0.6, std::numeric_limits<double>::quiet_NaN()}) {
        const auto fault = check(particles, {0.505, 0.0, deviation});
        REQUIRE(fault.has_value());
        CHECK(fault->kind == FaultKind::density);
        CHECK(fault->particle == 12);
        CHECK(fault->x[0] == Approx(0.2));
    }
}

TEST_CASE("WcsphHealth.SpeedNamesTheFastestAndItsRemedyTheParameter") {
    Particles particles = three_particles();
    particles.v[1][0] = 41.0;
    particles.v[1][1] = -50.0;
    const auto fault = check(particles, {0.0, 0.0, 0.0});
    REQUIRE(fault.has_value());
    CHECK(fault->kind == FaultKind::speed);
    CHECK(fault->particle == 11);
    CHECK(fault->v[1] == -50.0);
    CHECK(fault->remedy.find("reference_speed") != std::string::npos);
    RunLimits given = kLimits;
    given.sound_speed_by_rule = false;
    CHECK(check(particles, {0.0, 0.0, 0.0}, given)->remedy.find("raise sound_speed") != std::string::npos);
}

TEST_CASE("WcsphHealth.AStepMayCollapseOnlyByItsOwnForces") {
    Particles particles = three_particles();
    particles.a[0][2] = 1e9;
    RunLimits limits = kLimits;
    limits.next_step = 0.9e-3 * limits.acoustic_step;
    limits.limit = "body force";
    const auto fault = check(particles, {0.0, 0.0, 0.0}, limits);
    REQUIRE(fault.has_value());
    CHECK(fault->kind == FaultKind::time_step);
    CHECK(fault->particle == 12);
    limits.limit = "viscous";  // the scene's own choice
    CHECK_FALSE(check(particles, {0.0, 0.0, 0.0}, limits).has_value());
}

TEST_CASE("WcsphHealth.AStepThatNeverEndsIsAFaultWhoeverChoseIt") {
    RunLimits limits = kLimits;
    limits.limit = "viscous";
    limits.next_step = 0.9e-15;
    const auto fault = check(three_particles(), {0.0, 0.0, 0.0}, limits);
    REQUIRE(fault.has_value());
    CHECK(fault->kind == FaultKind::time_step);
    CHECK(fault->remedy.find("\"viscous\" leaves steps of 9e-16 s") != std::string::npos);
    limits.next_step = 1.1e-15;
    CHECK_FALSE(check(three_particles(), {0.0, 0.0, 0.0}, limits).has_value());
}

TEST_CASE("WcsphHealth.ConfinedFormsAreNamedWhereTheyBreakAFreeSurface") {
    RunLimits limits = kLimits;
    CHECK(remedy_for(FaultKind::density, limits).find("free_surface") == std::string::npos);
    limits.is_confined = true;
    CHECK(remedy_for(FaultKind::density, limits).find("set free_surface to true") != std::string::npos);
}

TEST_CASE("WcsphHealth.MissingShiftingIsNamedWhereParticlesCrowd") {
    RunLimits limits = kLimits;
    CHECK(remedy_for(FaultKind::density, limits).find("shifting") == std::string::npos);
    limits.shifts = false;
    CHECK(remedy_for(FaultKind::density, limits).find("set shifting to true") != std::string::npos);
    CHECK(remedy_for(FaultKind::speed, limits).find("set shifting to true") != std::string::npos);
}

TEST_CASE("WcsphHealth.RemediesFitTheCause") {
    RunLimits limits = kLimits;
    limits.cfl = 1.2;
    CHECK(remedy_for(FaultKind::non_finite, limits).starts_with("reduce cfl from 1.2 to 0.6"));
    CHECK(remedy_for(FaultKind::left_domain, limits).starts_with("reduce cfl"));
    limits.fixed_step = 2e-3;
    CHECK(remedy_for(FaultKind::density, limits).starts_with("set time_step to 0"));
    CHECK(remedy_for(FaultKind::left_domain, kLimits).starts_with("enlarge the domain"));
}

TEST_CASE("WcsphHealth.FaultsHaveTheNamesOfTheProtocol") {
    CHECK(std::string(name_of(FaultKind::non_finite)) == "non_finite");
    CHECK(std::string(name_of(FaultKind::left_domain)) == "left_domain");
    CHECK(std::string(name_of(FaultKind::density)) == "density");
    CHECK(std::string(name_of(FaultKind::speed)) == "speed");
    CHECK(std::string(name_of(FaultKind::time_step)) == "time_step");
}

TEST_CASE("Coincident.PairsMoveApartAndTheirCentreStays") {
    constexpr double dx = 0.1;
    Particles particles = three_particles();
    particles.x[0] = {0.5, 0.5, 0.5 + 0.5 * dx};
    particles.x[1] = {0.5, 0.5, 0.5};
    CHECK(separate_coincident(particles, dx, 1) == 1);
    CHECK(std::hypot(particles.x[0][0] - particles.x[0][1], particles.x[1][0] - particles.x[1][1]) ==
          Approx(2 * kCoincidentWay * dx));
    CHECK(particles.x[0][0] + particles.x[0][1] == Approx(1.0));
    CHECK(particles.x[0][2] == 0.5 + 0.5 * dx);  // not coincident: left alone
    CHECK(separate_coincident(particles, dx, 2) == 0);
}
