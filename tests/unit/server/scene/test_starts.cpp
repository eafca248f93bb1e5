#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "server/scene/run.h"
#include "server/scene/starts.h"

using namespace headrace;
using proto::Scalar;
using proto::ScalarVec3;

namespace {

constexpr double kSpacing = 0.1;

// 10 x 10 particles in 2D; the thesis model, which keeps no pressure wished for: looked at before it is initialised.
proto::SceneDesc square() {
    proto::SceneDesc scene;
    scene.name = "square";
    scene.dimensions = 2;
    scene.spacing = kSpacing;
    scene.domain = {{-1, -1}, {2, 2}};
    scene.fluids.push_back({"water", proto::BoxDesc{{0, 0}, {1, 1}}});
    scene.parameters["gravity"] = proto::Vec3{0, -10, 0};
    return scene;
}

// Does nothing but what a start asks a model for.
class StillModel final : public solver::Model {
  public:
    std::string_view name() const override { return "still"; }
    solver::StepReport initialise(solver::Particles&, const solver::Surroundings&) override { return {}; }
    solver::StepReport step(solver::Particles&, const solver::Surroundings&) override { return {}; }
    // Sorts the particles the other way round and remembers who might move.
    void relax(solver::Particles& particles, const solver::Surroundings&, const std::vector<bool>& spread) override {
        for (std::size_t i = 0; i < particles.size(); ++i)
            if (spread[i]) may_move.insert(particles.id[i]);
        std::reverse(particles.id.begin(), particles.id.end());
        for (auto& x : particles.x) std::reverse(x.begin(), x.end());
    }
    double hydrostatic_pressure(double weight) const override { return 2.0 * weight; }
    double time_step() const override { return 1.0; }
    std::string_view time_step_limit() const override { return "fixed"; }
    double particle_mass() const override { return 1.0; }
    double rest_density() const override { return 1000.0; }
    double support_radius() const override { return 0.3; }
    solver::Vec3 gravity() const override { return gravity_; }
    const std::vector<solver::ParameterInfo>& parameter_table() const override { return table_; }
    solver::ParameterMap parameters() const override { return {}; }
    std::optional<solver::ParameterError> set_parameters(const solver::ParameterMap&) override { return {}; }
    std::string strategy() const override { return "none"; }
    std::vector<solver::Stage> plan(const solver::Surroundings&) const override { return {}; }
    std::optional<std::string> refuse_object(const solver::CollisionObject&) const override { return {}; }
    std::optional<std::string> refuse_domain(const solver::Domain&) const override { return {}; }

    std::set<solver::Index> may_move;
    solver::Vec3 gravity_{0, -10, 0};

  private:
    std::vector<solver::ParameterInfo> table_;
};

solver::Particles placed(const proto::SceneDesc& scene) {
    scene::BuildControl control;
    auto particles = scene::place_fluids(scene, control);
    REQUIRE(particles.ok());
    return *particles;
}

solver::Particles started(const proto::SceneDesc& scene, StillModel& model) {
    solver::Particles particles = placed(scene);
    const auto status = scene::set_start(scene, model, {}, particles);
    if (!status) FAIL(status.error().path << ": " << status.error().message);
    return particles;
}

solver::Particles started(const proto::SceneDesc& scene) {
    StillModel model;
    return started(scene, model);
}

}  // namespace

TEST_CASE("Start.VelocityAndPressureFollowTheirExpressions") {
    proto::SceneDesc scene = square();
    scene.fluids[0].velocity = ScalarVec3{std::string("sin(2*pi*x)*cos(y)"), std::string("dx*y"), 0.0};
    scene.fluids[0].pressure = Scalar(std::string("100*(1 - y)"));
    const solver::Particles particles = started(scene);
    REQUIRE(particles.size() == 100);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double x = particles.x[0][i], y = particles.x[1][i];
        CHECK(particles.v[0][i] == Approx(std::sin(2 * M_PI * x) * std::cos(y)).margin(1e-14));
        CHECK(particles.v[1][i] == Approx(kSpacing * y));
        CHECK(particles.p[i] == Approx(100 * (1 - y)));
    }
}

TEST_CASE("Start.IsTheSameForAnyNumberOfThreads") {
    proto::SceneDesc scene = square();
    scene.spacing = 0.01;  // 10,000 particles: several blocks
    scene.fluids[0].velocity = ScalarVec3{std::string("sin(20*x)*exp(y)"), std::string("x/(1 + y)"), 0.0};
    scene.fluids[0].start.jitter = 0.3;
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    const solver::Particles one = started(scene);
    omp_set_num_threads(4);
    const solver::Particles four = started(scene);
    omp_set_num_threads(before);
    CHECK(one.x == four.x);
    CHECK(one.v == four.v);
}

TEST_CASE("Start.RefusesWhatIsNotFiniteAndSaysWhere") {
    proto::SceneDesc scene = square();
    scene.fluids[0].velocity[1] = Scalar(std::string("1/(x - 0.25)"));
    scene.fluids[0].shape = proto::BoxDesc{{0.2, 0}, {1.2, 1}};
    StillModel model;
    solver::Particles particles = placed(scene);
    const auto status = scene::set_start(scene, model, {}, particles);
    REQUIRE_FALSE(status.ok());
    CHECK(status.error().path == "scene.fluids[0].velocity[1]");
    CHECK(status.error().message.find("at (0.25, 0.05) m") != std::string::npos);
}

TEST_CASE("Start.HydrostaticPressureIsThatOfTheDepth") {
    proto::SceneDesc scene = square();
    scene.fluids[0].hydrostatic = true;
    scene.fluids.push_back({"dry", proto::BoxDesc{{1, 0}, {1.2, 0.5}}});
    const solver::Particles particles = started(scene);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        // The model makes twice the weight of it: what it says counts.
        const double expected = particles.id[i] < 100 ? 2.0 * 1000.0 * 10.0 * (1.0 - particles.x[1][i]) : 0.0;
        CHECK(particles.p[i] == Approx(expected));
    }
}

TEST_CASE("Start.HydrostaticDepthIsAlongGravity") {
    proto::SceneDesc scene = square();
    scene.fluids[0].hydrostatic = true;
    StillModel model;
    model.gravity_ = {6, -8, 0};  // up: (-0.6, 0.8); the highest corner is (0, 1)
    const solver::Particles particles = started(scene, model);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double depth = 0.8 - (-0.6 * particles.x[0][i] + 0.8 * particles.x[1][i]);
        CHECK(particles.p[i] == Approx(2.0 * 1000.0 * 10.0 * depth));
    }
    model.gravity_ = {};
    CHECK(started(scene, model).p[0] == 0.0);
}

TEST_CASE("Start.JitterIsBoundedEvenAndRepeatable") {
    proto::SceneDesc scene = square();
    scene.spacing = 0.01;
    const solver::Particles lattice = placed(scene);
    scene.fluids[0].start.jitter = 0.2;
    const solver::Particles jittered = placed(scene);
    CHECK(placed(scene).x == jittered.x);
    const double reach = 0.2 * scene.spacing;
    for (int axis = 0; axis < 2; ++axis) {
        double sum = 0.0, squares = 0.0, largest = 0.0;
        for (std::size_t i = 0; i < lattice.size(); ++i) {
            const double moved = (jittered.x[axis][i] - lattice.x[axis][i]) / reach;
            sum += moved;
            squares += moved * moved;
            largest = std::max(largest, std::abs(moved));
        }
        const double n = static_cast<double>(lattice.size());
        CHECK(largest <= 1.0 + 1e-9);
        CHECK(largest > 0.99);                              // 10^4 draws: a miss has probability 0.99^10000
        CHECK(std::abs(sum / n) < 4.0 / std::sqrt(3 * n));  // four standard errors of a uniform mean
        CHECK(squares / n == Approx(1.0 / 3.0).margin(4.0 * 0.298 / std::sqrt(n)));
    }
    scene.fluids[0].start.seed = 1;
    CHECK(placed(scene).x != jittered.x);
}

TEST_CASE("Start.RandomNumbersAreSplitMix64") {
    // First outputs of the published generator for the seed 0: E220A8397B1DCDAF, 6E789E6AA1B965F4.
    CHECK(scene::uniform_random(0, 0) == static_cast<double>(0xE220A8397B1DCDAFu >> 11) * 0x1.0p-53);
    CHECK(scene::uniform_random(0, 1) == static_cast<double>(0x6E789E6AA1B965F4u >> 11) * 0x1.0p-53);
}

TEST_CASE("Start.RelaxesTheFluidsThatAskForIt") {
    proto::SceneDesc scene = square();
    scene.fluids.push_back({"drop", proto::BoxDesc{{1.2, 0}, {1.4, 0.2}}});
    scene.fluids[1].start.relaxed = true;
    scene.fluids[1].velocity[0] = 7.0;
    StillModel model;
    const solver::Particles particles = started(scene, model);
    CHECK(model.may_move == std::set<solver::Index>{100, 101, 102, 103});
    // The model sorted the particles; velocities go by the name of each.
    for (std::size_t i = 0; i < particles.size(); ++i) CHECK(particles.v[0][i] == (particles.id[i] >= 100 ? 7.0 : 0.0));
    scene.fluids[1].start.relaxed = false;
    StillModel unasked;
    started(scene, unasked);
    CHECK(unasked.may_move.empty());
}
