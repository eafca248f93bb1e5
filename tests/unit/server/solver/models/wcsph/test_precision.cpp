// What single precision in the pair sums does to the model, and what it must not do.
#include <catch2/catch.hpp>

#include "scenes.h"
#include "server/solver/pairs/instruction_sets.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

// Water in a tank, stirred, with its corner at `origin`; after one step, by id.
struct State {
    VectorField a;
    double largest{};  // acceleration [m/s^2]
};

State after_one_step(int dimensions, const std::string& precision, double origin) {
    Scene scene = make_tank(dimensions, dimensions == 2 ? 40 : 20);
    displace_randomly(scene.particles, 0.1 * scene.dx, 3);
    set_random_state(scene.particles, 100.0, 5);
    for (int k = 0; k < dimensions; ++k) {
        for (double& x : scene.particles.x[k]) x += origin;
    }
    scene.domain.min = {-0.5 + origin, -0.5 + origin, -0.5 + origin};
    scene.domain.max = {1.5 + origin, 2.5 + origin, 1.5 + origin};
    auto& box = std::get<Box>(scene.objects[0].shape);
    for (double& c : box.center) c += origin;
    scene.parameters["precision"] = precision;
    REQUIRE_FALSE(scene.start().fault);
    REQUIRE_FALSE(scene.step().fault);
    State state;
    for (int k = 0; k < dimensions; ++k) {
        state.a[k].resize(scene.particles.size());
        for (std::size_t i = 0; i < scene.particles.size(); ++i) {
            state.a[k][scene.particles.id[i]] = scene.particles.a[k][i];
            state.largest = std::max(state.largest, std::abs(scene.particles.a[k][i]));
        }
    }
    return state;
}

struct Difference {
    double rms{}, largest{};  // over the largest acceleration
};
Difference compare(const State& one, const State& other, int dimensions) {
    Difference difference;
    double sum = 0.0;
    std::size_t count = 0;
    for (int k = 0; k < dimensions; ++k) {
        for (std::size_t i = 0; i < one.a[k].size(); ++i, ++count) {
            const double d = std::abs(one.a[k][i] - other.a[k][i]) / other.largest;
            sum += d * d;
            difference.largest = std::max(difference.largest, d);
        }
    }
    difference.rms = std::sqrt(sum / static_cast<double>(count));
    return difference;
}

}  // namespace

TEST_CASE("WcsphPrecision.SinglePrecisionIsAsGoodAsItsNumbers") {
    // Sums of some hundred terms, each rounded to 6e-8 of itself at random, and places to 4e-8 of twelve spacings.
    const int dimensions = GENERATE(2, 3);
    const Difference d =
        compare(after_one_step(dimensions, "single", 0.0), after_one_step(dimensions, "double", 0.0), dimensions);
    INFO(dimensions << "D: rms " << d.rms << ", largest " << d.largest);
    CHECK(d.rms < 1e-6);
    CHECK(d.largest < 1e-5);
    CHECK(d.largest > 0.0);  // it was single
}

TEST_CASE("WcsphPrecision.FarFromTheOriginIsAsGoodAsNearIt") {
    // 10^4 spacings away, single precision of the places themselves would leave an error of 6e-4 spacings. Relative
    // places that round the other way by 6e-8 are all that may differ: of a hundred terms each, 10 times that at most.
    const int dimensions = GENERATE(2, 3);
    const std::string set = GENERATE(from_range(instruction_sets()));
    const OnlyInstructionSet only(set);
    const double away = 1e4 * (dimensions == 2 ? 1.0 / 40 : 1.0 / 20);
    const Difference d =
        compare(after_one_step(dimensions, "single", away), after_one_step(dimensions, "single", 0.0), dimensions);
    INFO(dimensions << "D, " << set << ": rms " << d.rms << ", largest " << d.largest);
    CHECK(d.rms < 1e-6);
    CHECK(d.largest < 1e-6);
}

TEST_CASE("WcsphPrecision.SinglePrecisionHasTheSameBitsForAnyThreadCount") {
    // Water thrown into a corner: lists are made anew while it breaks. Thread counts that change from step to step are
    // as good as any.
    const int dimensions = GENERATE(2, 3);
    const auto hash_with = [&](int threads, bool is_changing) {
        std::uint64_t hash = 0;
        with_threads(threads, [&] {
            Scene scene = make_tank(dimensions, dimensions == 2 ? 40 : 20);  // many blocks of the lists
            set_random_state(scene.particles, 100.0, 5);
            for (double& v : scene.particles.v[0]) v -= 3.0;
            scene.parameters["precision"] = std::string("single");
            REQUIRE_FALSE(scene.start().fault);
            bool is_sound = true;
            for (int k = 0; k < 60; ++k) {
                if (is_changing) team_limit = 1 + k % threads;
                is_sound = is_sound && !scene.step().fault;
            }
            team_limit = 0;
            REQUIRE(is_sound);
            const std::string lists = scene.model->plan(scene.surroundings()).front().reason;
            INFO(lists);
            CHECK(lists.find("sorted once") == std::string::npos);
            hash = compute_state_hash(scene.particles);
        });
        return hash;
    };
    const std::uint64_t one = hash_with(1, false);
    for (const int threads : {2, 3, 4}) CHECK(hash_with(threads, false) == one);
    CHECK(hash_with(4, true) == one);
}

TEST_CASE("WcsphPrecision.TinySpacingsAreSummedInDouble") {
    Scene scene;
    scene.model = make_model("wcsph", 2, 1e-7, {});
    scene.dx = 1e-7;
    scene.particles = make_particles(2, {{0, 0, 0}});
    scene.parameters = {{"sound_speed", 1.0}};
    scene.model = make_model("wcsph", 2, scene.dx, scene.parameters);
    REQUIRE_FALSE(scene.model->initialise(scene.particles, scene.surroundings()).fault);
    const auto plan = scene.model->plan(scene.surroundings());
    CHECK(plan.front().reason.find("double precision") != std::string::npos);
}
