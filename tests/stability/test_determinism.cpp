// Same scene, same commands, same binary: the same bits for any number of threads.
#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "proto/messages_json.h"
#include "proto/presets.h"
#include "server/scene/run.h"
#include "server/solver/diagnostics.h"

using namespace headrace;

namespace {

proto::SceneDesc preset(std::string_view name) {
    for (const proto::Preset& candidate : proto::presets())
        if (candidate.name == name) return proto::parse_scene(candidate.json).value();
    FAIL("no preset " << name);
    return {};
}

// A run with everything that can happen between steps: an object goes, one comes and moves, parameters change.
std::uint64_t hash_after_commands(const proto::SceneDesc& scene, int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    auto built = scene::Run::build(scene);
    REQUIRE(built.ok());
    scene::Run& run = **built;
    for (int step = 0; step < 160; ++step) {
        if (step == 60 && scene.name == "dam_break") REQUIRE(run.remove_object("panel").ok());
        if (step == 80) REQUIRE(run.set_parameters({{"viscosity", 5.0}}).ok());
        if (step == 100) {
            proto::Vec3 low = scene.domain.min;
            low[1] += 0.1;
            REQUIRE(run.add_object({"ball", proto::ObjectRole::obstacle, proto::SphereDesc{low, 0.05}}).ok());
            REQUIRE(run.move_object("ball", {}, proto::Vec3{0.1, 0.05, 0.0}).ok());
        }
        run.step();
    }
    omp_set_num_threads(before);
    REQUIRE_FALSE(run.last_report().fault.has_value());
    return solver::compute_state_hash(run.particles());
}

}  // namespace

TEST_CASE("Determinism.AnyNumberOfThreadsGivesTheSameBits") {
    const auto name = GENERATE(as<std::string>{}, "dam_break", "bowl", "obstacle", "dam_break_2d");
    INFO(name);
    const proto::SceneDesc scene = preset(name);
    const std::uint64_t expected = hash_after_commands(scene, 1);
    CHECK(hash_after_commands(scene, 1) == expected);
    for (const int threads : {2, 3, 4}) CHECK(hash_after_commands(scene, threads) == expected);
}

TEST_CASE("Determinism.TheHashSeesASingleBit") {
    const auto built = scene::Run::build(preset("dam_break_2d"));
    REQUIRE(built.ok());
    solver::Particles particles = (*built)->particles();
    const std::uint64_t before = solver::compute_state_hash(particles);
    particles.x[1][7] = std::nextafter(particles.x[1][7], 1e9);
    CHECK(solver::compute_state_hash(particles) != before);
}
