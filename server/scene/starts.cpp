#include "server/scene/starts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "proto/values/expressions.h"
#include "server/scene/sampling.h"
#include "server/scene/shapes.h"
#include "server/scene/validate.h"
#include "server/scene/vectors.h"
#include "server/solver/parallel.h"

namespace headrace::scene {

using proto::Done;
using proto::Error;
using proto::ErrorCode;
using proto::Result;
using proto::Status;
using proto::Vec3;

namespace {

Vec3 place(const solver::Particles& particles, std::size_t slot) {
    return {particles.x[0][slot], particles.x[1][slot], particles.dimensions == 3 ? particles.x[2][slot] : 0.0};
}

// Slots of the particles of each fluid; a model may have sorted them, ids tell.
std::vector<std::vector<std::size_t>> slots_of_fluids(const proto::SceneDesc& scene, const solver::Particles& particles,
                                                      const FluidFiles& files) {
    std::vector<std::size_t> ends;  // first id behind each fluid
    for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
        const auto file = files.find(k);
        const std::size_t count =
            file != files.end()
                ? file->second.x.size()
                : static_cast<std::size_t>(count_particles(scene.fluids[k], scene.dimensions, scene.spacing));
        ends.push_back((ends.empty() ? 0 : ends.back()) + count);
    }
    std::vector<std::vector<std::size_t>> slots(scene.fluids.size());
    for (std::size_t slot = 0; slot < particles.size(); ++slot) {
        const auto fluid = std::upper_bound(ends.begin(), ends.end(), particles.id[slot]) - ends.begin();
        slots[static_cast<std::size_t>(fluid)].push_back(slot);
    }
    return slots;
}

// field[slot] = formula at the particle, for all slots; the first that is not finite refuses the scene.
Status fill(std::vector<double>& field, const std::vector<std::size_t>& slots, const solver::Particles& particles,
            const Formula& formula, const std::string& path) {
    FormulaTeam team(formula);
    team.prepare(solver::max_threads());
    solver::parallel_for(slots.size(), solver::kParticleBlock, [&](std::size_t begin, std::size_t end, int thread) {
        for (std::size_t k = begin; k < end; ++k) field[slots[k]] = team(thread, place(particles, slots[k]), 0.0);
    });
    for (const std::size_t slot : slots)
        if (!std::isfinite(field[slot]))
            return Error{ErrorCode::scene_invalid,
                         "is " + value_at_text(field[slot], place(particles, slot), particles.dimensions), path,
                         "the expression must be finite in the whole fluid"};
    return Done{};
}

// field[slot] = value(place of the slot's particle in its file). Ids of a fluid are consecutive, in the file's order.
template <class Value>
void take_values(std::vector<double>& field, const std::vector<std::size_t>& slots, const solver::Particles& particles,
                 const Value& value) {
    solver::Index first = std::numeric_limits<solver::Index>::max();
    for (const std::size_t slot : slots) first = std::min(first, particles.id[slot]);
    for (const std::size_t slot : slots) field[slot] = value(particles.id[slot] - first);
}

void fill_hydrostatic(const proto::FluidDesc& fluid, const std::vector<std::size_t>& slots, const solver::Model& model,
                      solver::Particles& particles) {
    const solver::Vec3 gravity = model.gravity();
    const double g = norm(gravity);
    if (g == 0.0) return;
    const Vec3 up = scaled(-1.0 / g, gravity);
    const double top = highest_point(fluid.shape, up, particles.dimensions);
    for (const std::size_t slot : slots) {
        const double depth = std::max(0.0, top - dot(place(particles, slot), up));
        particles.p[slot] = model.hydrostatic_pressure(model.rest_density() * g * depth);
    }
}

}  // namespace

double uniform_random(std::uint64_t seed, std::uint64_t counter) {
    std::uint64_t z = seed + (counter + 1) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1.0p-53;
}

Result<solver::Particles> place_fluids(const proto::SceneDesc& scene, BuildControl& control, const FluidFiles& files) {
    const auto count = static_cast<std::size_t>(count_particles(scene, files));
    solver::Particles particles;
    particles.dimensions = scene.dimensions;
    particles.resize(count);
    std::size_t slot = 0;
    for (std::size_t fluid_number = 0; fluid_number < scene.fluids.size(); ++fluid_number) {
        const proto::FluidDesc& fluid = scene.fluids[fluid_number];
        const double reach = fluid.start.jitter * scene.spacing;
        const auto seed = static_cast<std::uint64_t>(fluid.start.seed);
        const auto put = [&](const Vec3& x) {
            for (int k = 0; k < scene.dimensions; ++k) {
                const double random = reach == 0.0 ? 0.0 : 2.0 * uniform_random(seed, 3 * slot + k) - 1.0;
                particles.x[k][slot] = x[k] + reach * random;
            }
            particles.id[slot] = static_cast<solver::Index>(slot);
            ++slot;
            if (slot % 65'536 == 0)
                control.progress = 0.4 + 0.3 * static_cast<double>(slot) / static_cast<double>(count);
            return !control.cancelled;
        };
        if (const auto file = files.find(fluid_number); file != files.end())
            std::all_of(file->second.x.begin(), file->second.x.end(), put);
        else
            for_each_lattice_point(fluid.shape, scene.dimensions, scene.spacing, put);
    }
    if (control.cancelled) return cancelled_error();
    return particles;
}

Status set_start(const proto::SceneDesc& scene, solver::Model& model, const solver::Surroundings& surroundings,
                 solver::Particles& particles, const FluidFiles& files) {
    std::vector<std::vector<std::size_t>> slots = slots_of_fluids(scene, particles, files);
    std::vector<bool> spread(particles.size(), false);
    bool any_relaxed = false;
    for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
        if (!scene.fluids[k].start.relaxed) continue;
        any_relaxed = true;
        for (const std::size_t slot : slots[k]) spread[slot] = true;
    }
    if (any_relaxed) {
        model.relax(particles, surroundings, spread);
        slots = slots_of_fluids(scene, particles, files);
    }

    const Symbols symbols{.dimensions = scene.dimensions, .spacing = scene.spacing, .position = true};
    for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
        const proto::FluidDesc& fluid = scene.fluids[k];
        const std::string path = "scene.fluids[" + std::to_string(k) + "]";
        const auto velocity = compile_vector(fluid.velocity, symbols, path + ".velocity");
        if (!velocity) return velocity.error();
        for (int axis = 0; axis < scene.dimensions; ++axis)
            if (Status status = fill(particles.v[axis], slots[k], particles, (*velocity)[axis],
                                     path + ".velocity[" + std::to_string(axis) + "]");
                !status)
                return status;
    }
    for (const auto& [fluid, set] : files)
        if (!set.v.empty())
            for (int axis = 0; axis < scene.dimensions; ++axis)
                take_values(particles.v[axis], slots[fluid], particles,
                            [&set = set, axis](std::size_t k) { return set.v[k][axis]; });
    model.prepare(particles, surroundings);
    for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
        const proto::FluidDesc& fluid = scene.fluids[k];
        const std::string path = "scene.fluids[" + std::to_string(k) + "]";
        if (fluid.hydrostatic) fill_hydrostatic(fluid, slots[k], model, particles);
        if (!fluid.pressure) continue;
        const auto pressure = Formula::compile(*fluid.pressure, symbols, path + ".pressure");
        if (!pressure) return pressure.error();
        if (Status status = fill(particles.p, slots[k], particles, *pressure, path + ".pressure"); !status)
            return status;
    }
    for (const auto& [fluid, set] : files)
        if (!set.p.empty())
            take_values(particles.p, slots[fluid], particles, [&set = set](std::size_t k) { return set.p[k]; });
    return Done{};
}

}  // namespace headrace::scene
