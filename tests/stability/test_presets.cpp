// The small presets run for seconds of simulated time without a fault, gaining no energy and losing no particle.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "proto/messages_json.h"
#include "proto/presets.h"
#include "server/scene/run.h"

using namespace headrace;

TEST_CASE("Presets.RunForSecondsWithoutAFault") {
    const auto name = GENERATE(as<std::string>{}, "dam_break", "bowl", "obstacle", "dam_break_2d");
    INFO(name);
    proto::SceneDesc scene;
    for (const proto::Preset& preset : proto::presets())
        if (preset.name == name) scene = proto::parse_scene(preset.json).value();
    auto built = scene::Run::build(scene);
    REQUIRE(built.ok());
    scene::Run& run = **built;

    // Walls only take energy and the fluid starts at rest, uncompressed but for the lattice: kinetic and potential
    // energy together may exceed the start only by what the soft springs between particles can give back. A tenth of m
    // g H bounds that in all four scenes.
    const solver::Diagnostics start = run.diagnostics();
    const double mass = run.model().particle_mass() * static_cast<double>(run.particles().size());
    const double allowance = 0.1 * mass * 9.82 * run.fluid_height();
    const std::size_t particles = run.particles().size();
    double largest_gain = -1e300;
    while (run.time() < 3.0) {
        REQUIRE_FALSE(run.step().fault.has_value());
        const solver::Diagnostics now = run.diagnostics();
        largest_gain = std::max(
            largest_gain, now.kinetic_energy + now.potential_energy - start.kinetic_energy - start.potential_energy);
    }
    CHECK(run.particles().size() == particles);
    CHECK(largest_gain < allowance);
    // Something has happened: the fluid has come down.
    CHECK(run.diagnostics().potential_energy < start.potential_energy);
}
