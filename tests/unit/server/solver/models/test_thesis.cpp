#include <algorithm>
#include <catch2/catch.hpp>

#include "../fixtures.h"
#include "server/solver/diagnostics.h"
#include "server/solver/models/registry.h"
#include "server/solver/parallel.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

constexpr Domain kWide{{-10, -10, -10}, {10, 10, 10}};
const double s = kThesisSpacing;  // [m]

const CollisionObject kTank{"tank", Role::container, Box{{0.4, 0.4, 0.1}, {0.4, 0.4, 0.1}}};

// A column 13 particles wide in a tank, held by a panel 2 cm thick.
std::vector<CollisionObject> tank_with_panel() {
    return {kTank, {"panel", Role::obstacle, Box{{13 * s + 0.0101, 0.4, 0.1}, {0.01, 0.5, 0.2}}}};
}

std::uint64_t hash_after(int steps, int threads, Particles particles, std::vector<CollisionObject> objects) {
    const int before = max_threads();
    omp_set_num_threads(threads);
    const auto model = make_model("thesis", particles.dimensions, s, {});
    model->initialise(particles, {objects, kWide});
    for (int i = 0; i < steps; ++i) {
        if (i == steps / 2 && objects.size() > 1) objects.pop_back();
        model->step(particles, {objects, kWide});
    }
    omp_set_num_threads(before);
    return compute_state_hash(particles);
}

void check_thread_invariance(const Particles& particles, const std::vector<CollisionObject>& objects) {
    const std::uint64_t one = hash_after(50, 1, particles, objects);
    for (const int threads : {2, 3, 4}) CHECK(hash_after(50, threads, particles, objects) == one);
}

const Stage& find_stage(const std::vector<Stage>& plan, const std::string& name) {
    const auto found = std::find_if(plan.begin(), plan.end(), [&](const Stage& stage) { return stage.name == name; });
    REQUIRE(found != plan.end());
    return *found;
}

double separation(const Particles& particles, Index a, Index b) {
    const Vec3 x_a = at(particles.x, particles.dimensions, slot_of(particles, a));
    const Vec3 x_b = at(particles.x, particles.dimensions, slot_of(particles, b));
    return std::sqrt(std::pow(x_a[0] - x_b[0], 2) + std::pow(x_a[1] - x_b[1], 2) + std::pow(x_a[2] - x_b[2], 2));
}

}  // namespace

TEST_CASE("Thesis.DamBreakHasTheSameBitsForAnyThreadCount") {
    // more than two blocks of particles, so that threads do share the work
    check_thread_invariance(make_particles(3, lattice({13, 24, 7}, s)), tank_with_panel());
}

TEST_CASE("Thesis.BowlHasTheSameBitsForAnyThreadCount") {
    check_thread_invariance(make_particles(3, lattice({13, 13, 13}, s, {-6.5 * s, -6.5 * s, -6.5 * s})),
                            {{"bowl", Role::container, Sphere{{0, 0, 0}, 0.35}}});
}

TEST_CASE("Thesis.FlatDamBreakHasTheSameBitsForAnyThreadCount") {
    check_thread_invariance(make_particles(2, lattice({28, 80, 1}, 0.5 * s)), {kTank});
}

TEST_CASE("Thesis.LoneParticleFallsAsLeapFrogSays") {
    Particles particles = make_particles(3, {{0, 5, 0}});
    const auto model = make_model("thesis", 3, s, {});
    model->initialise(particles, {{}, kWide});
    CHECK(particles.v_half[1][0] == Approx(0.5 * 0.01 * 9.82));  // 2.35
    StepReport report;
    for (int i = 0; i < 50; ++i) report = model->step(particles, {{}, kWide});
    // exact for constant acceleration but for rounding; v is that of the step's beginning, t = 49 dt
    CHECK(particles.x[1][0] == Approx(5.0 - 0.5 * 9.82 * 0.25).epsilon(1e-12));
    CHECK(particles.v[1][0] == Approx(-9.82 * 0.49).epsilon(1e-12));
    CHECK(report.max_speed == Approx(9.82 * 0.49).epsilon(1e-12));
    CHECK(report.dt == Approx(0.01));
}

TEST_CASE("Thesis.FreeFluidConservesMomentum") {
    // No walls, no gravity: the pair forces cancel, surface tension alone is not pairwise and is off.
    Particles particles = make_particles(3, lattice({6, 6, 6}, 0.7 * s));
    const auto model = make_model("thesis", 3, s, {{"gravity", Vec3{}}, {"surface_tension", 0.0}});
    model->initialise(particles, {{}, kWide});
    for (int i = 0; i < 30; ++i) model->step(particles, {{}, kWide});
    for (int k = 0; k < 3; ++k) {
        double sum = 0.0, size = 0.0;
        for (const double v : particles.v_half[k]) {
            sum += v;
            size += std::abs(v);
        }
        CHECK(size > 1.0);                    // it did expand
        CHECK(std::abs(sum) < 1e-11 * size);  // rounding of 30 steps
    }
}

TEST_CASE("Thesis.ViscosityDissipatesEnergy") {
    Particles particles = make_particles(3, lattice({6, 6, 6}, s));
    for (std::size_t i = 0; i < particles.size(); ++i) particles.v[0][i] = particles.x[1][i];
    const auto model = make_model("thesis", 3, s, {{"gravity", Vec3{}}, {"surface_tension", 0.0}, {"stiffness", 0.0}});
    model->initialise(particles, {{}, kWide});
    model->initialise(particles, {{}, kWide});
    double before = compute_diagnostics(particles, {}).kinetic_energy;
    CHECK(before > 0.0);
    for (int i = 0; i < 20; ++i) {
        model->step(particles, {{}, kWide});
        const double now = compute_diagnostics(particles, {}).kinetic_energy;
        CHECK(now <= before * (1.0 + 1e-12));
        before = now;
    }
}

TEST_CASE("Thesis.PanelDoesNotLeak") {
    Particles particles = make_particles(3, lattice({8, 12, 7}, s));
    // A panel of 0.1 mm under a stream of 20 m/s: 200 mm a step.
    const std::vector<CollisionObject> objects{
        kTank, {"panel", Role::obstacle, Box{{8 * s + 0.01, 0.4, 0.1}, {0.00005, 0.5, 0.2}}}};
    particles.v[0].assign(particles.size(), 20.0);
    const auto model = make_model("thesis", 3, s, {});
    model->initialise(particles, {objects, kWide});
    for (int i = 0; i < 40; ++i) {
        model->step(particles, {objects, kWide});
        CHECK(*std::max_element(particles.x[0].begin(), particles.x[0].end()) <= 8 * s + 0.01);
    }
}

TEST_CASE("Thesis.PairInACornerSeparates") {
    // Heavy gravity into the corner presses both onto one point in the first step.
    Particles particles = make_particles(3, {{0.001, 0.001, 0.001}, {0.002, 0.0015, 0.001}});
    const std::vector<CollisionObject> objects{kTank};
    for (const bool separate : {true, false}) {
        const auto model =
            make_model("thesis", 3, s, {{"gravity", Vec3{-20, -20, -20}}, {"separate_coincident", separate}});
        Particles pair = particles;
        for (int k = 0; k < 3; ++k) pair.v[k] = {-2.0, -2.0};
        model->initialise(pair, {objects, kWide});
        model->step(pair, {objects, kWide});
        REQUIRE(separation(pair, 0, 1) == 0.0);
        double largest = 0.0;
        for (int i = 0; i < 20; ++i) {
            model->step(pair, {objects, kWide});
            largest = std::max(largest, separation(pair, 0, 1));
        }
        if (separate) {
            CHECK(largest > 1e-3 * s);
        } else {
            CHECK(largest == 0.0);  // Fig. 2.7
        }
    }
}

TEST_CASE("Thesis.CoincidentPairInTheOpenSeparates") {
    for (const int dimensions : {2, 3}) {
        Particles particles = make_particles(dimensions, {{0.3, 0.3, 0.1}, {0.3, 0.3, 0.1}});
        const auto model = make_model("thesis", dimensions, s, {{"gravity", Vec3{}}});
        model->initialise(particles, {{}, kWide});
        for (int i = 0; i < 5; ++i) model->step(particles, {{}, kWide});
        CHECK(separation(particles, 0, 1) > 0.01 * s);
    }
}

TEST_CASE("Thesis.BadVelocityFaultsTheStepWithTheLowestId") {
    Particles particles = make_particles(3, lattice({6, 6, 6}, s));
    const auto model = make_model("thesis", 3, s, {});
    CHECK_FALSE(model->initialise(particles, {{}, kWide}).fault);
    particles.v_half[1][slot_of(particles, 77)] = std::nan("");
    const StepReport report = model->step(particles, {{}, kWide});
    REQUIRE(report.fault);
    CHECK(report.fault->kind == FaultKind::non_finite);
    CHECK(report.fault->particle == 77);
    CHECK(report.fault->remedy.find("time_step") != std::string::npos);
    CHECK_FALSE(std::isfinite(particles.x[1][slot_of(particles, 77)]));  // the state is kept
    CHECK(model->step(particles, {{}, kWide}).fault);                    // and may be stepped without harm
}

TEST_CASE("Thesis.LeavingTheDomainFaults") {
    Particles particles = make_particles(3, {{0, 0.02, 0}});
    const Domain domain{{-1, 0, -1}, {1, 1, 1}};
    const auto model = make_model("thesis", 3, s, {});
    model->initialise(particles, {{}, domain});
    int steps = 0;
    StepReport report;
    while (!report.fault && steps < 100) {
        report = model->step(particles, {{}, domain});
        ++steps;
    }
    // g t^2 / 2 = 0.02 at t = 0.0638
    CHECK(steps == 7);
    REQUIRE(report.fault);
    CHECK(report.fault->kind == FaultKind::left_domain);
    CHECK(report.fault->x[1] < 0.0);
    CHECK(report.fault->remedy.find("enlarge domain") != std::string::npos);
    CHECK(make_model("thesis", 3, s, {})->initialise(particles, {{}, domain}).fault);
}

TEST_CASE("Thesis.TooLongAStepGetsTheLimitAsRemedy") {
    Particles particles = make_particles(3, lattice({6, 6, 6}, s));
    const auto model = make_model("thesis", 3, s, {{"time_step", 0.5}});
    model->initialise(particles, {{}, kWide});
    StepReport report;
    for (int i = 0; i < 50 && !report.fault; ++i) report = model->step(particles, {{}, kWide});
    REQUIRE(report.fault);
    CHECK(report.fault->remedy.find("reduce time_step below") != std::string::npos);
    CHECK(report.fault->remedy.find("s (acoustic limit)") != std::string::npos);
}

TEST_CASE("Thesis.TimeStepMayChangeMidRun") {
    Particles particles = make_particles(3, {{0, 9, 0}});
    const auto model = make_model("thesis", 3, s, {});
    model->initialise(particles, {{}, kWide});
    double t = 0.0;
    for (int i = 0; i < 60; ++i) {
        if (i == 20) CHECK_FALSE(model->set_parameters({{"time_step", 0.004}}));
        if (i == 40) CHECK_FALSE(model->set_parameters({{"time_step", 0.016}}));
        t += model->step(particles, {{}, kWide}).dt;
    }
    CHECK(t == Approx(20 * (0.01 + 0.004 + 0.016)));
    CHECK(model->time_step() == 0.016);
    // The mean of both steps keeps v_half = -g (t - dt/2) exactly; each change then shifts x by g dt (dt_b -
    // dt_a)/8-ish terms of second order: below g dt^2.
    CHECK(particles.v_half[1][0] == Approx(-9.82 * (t - 0.008)).epsilon(1e-12));
    CHECK(std::abs(particles.x[1][0] - (9.0 - 0.5 * 9.82 * t * t)) < 9.82 * 0.016 * 0.016);
}

TEST_CASE("Thesis.ParametersMayChangeBetweenSteps") {
    Particles particles = make_particles(3, lattice({6, 6, 6}, s));
    const auto model = make_model("thesis", 3, s, {});
    model->initialise(particles, {{&kTank, 1}, kWide});
    model->step(particles, {{&kTank, 1}, kWide});
    REQUIRE_FALSE(model->set_parameters({{"support_radius", 0.07}, {"pressure_form", std::string("symmetric")}}));
    CHECK(std::get<double>(model->parameters().at("support_radius")) == 0.07);
    CHECK(std::get<double>(model->parameters().at("time_step")) == Approx(0.01 * 0.07 / 0.0457));
    CHECK_FALSE(model->step(particles, {{&kTank, 1}, kWide}).fault);
    // all or none
    const auto error = model->set_parameters({{"gravity", Vec3{}}, {"viscosity", -1.0}});
    REQUIRE(error);
    CHECK(error->name == "viscosity");
    CHECK(model->gravity() == Vec3{0.0, -9.82, 0.0});
}

TEST_CASE("Thesis.PlanSkipsWhatHasNoEffect") {
    const auto model = make_model("thesis", 3, s, {{"surface_tension", 0.0}, {"viscosity", 0.0}, {"gravity", Vec3{}}});
    const auto plan = model->plan({{}, kWide});
    for (const char* name : {"surface_tension", "viscosity", "gravity", "collide"})
        CHECK_FALSE(find_stage(plan, name).active);
    CHECK(find_stage(plan, "surface_tension").reason == "coefficient is 0");
    CHECK(find_stage(plan, "density").active);
    REQUIRE_FALSE(model->set_parameters({{"surface_tension", 0.07}, {"viscosity", 1.0}, {"gravity", Vec3{0, -1, 0}}}));
    for (const Stage& stage : model->plan({{&kTank, 1}, kWide})) CHECK(stage.active);
}

TEST_CASE("Thesis.PlanCarriesTheTimeSpent") {
    Particles particles = make_particles(3, lattice({10, 10, 10}, s));
    const auto model = make_model("thesis", 3, s, {});
    CHECK(find_stage(model->plan({{}, kWide}), "density").seconds == 0.0);
    model->initialise(particles, {{}, kWide});
    model->step(particles, {{}, kWide});
    for (const char* name : {"neighbours", "density", "pressure_force", "integrate", "check"}) {
        CHECK(find_stage(model->plan({{}, kWide}), name).seconds > 0.0);
    }
}

TEST_CASE("Thesis.EmptySceneSteps") {
    Particles particles = make_particles(3, {});
    const auto model = make_model("thesis", 3, s, {});
    CHECK_FALSE(model->initialise(particles, {{}, kWide}).fault);
    const StepReport report = model->step(particles, {{&kTank, 1}, kWide});
    CHECK_FALSE(report.fault);
    CHECK(report.max_speed == 0.0);
}

TEST_CASE("Thesis.HugeDomainCostsNothing") {
    const Domain huge{{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}};
    auto points = lattice({6, 6, 6}, s);
    points.push_back({9e5, -9e5, 9e5});
    Particles particles = make_particles(3, points);
    const auto model = make_model("thesis", 3, s, {{"support_radius", 0.01}});
    CHECK_FALSE(model->initialise(particles, {{}, huge}).fault);
    CHECK_FALSE(model->step(particles, {{}, huge}).fault);
}
