// The particles of a scene at t = 0: where they stand, how fast they are, which pressure they have.
#pragma once

#include <cstdint>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "server/scene/build_control.h"
#include "server/scene/particle_file.h"
#include "server/solver/model.h"

namespace headrace::scene {

// Uniform in [0, 1) from a seed and a counter (SplitMix64: Steele, Lea, Flood 2014): the same on every machine and for
// any order of the calls.
double uniform_random(std::uint64_t seed, std::uint64_t counter);

// Lattices and files of all fluids in the scene's order, jittered where asked for; ids count up from 0. Errors:
// cancelled.
proto::Result<solver::Particles> place_fluids(const proto::SceneDesc& scene, BuildControl& control,
                                              const FluidFiles& files = {});

// Spreads the particles of fluids with a relaxed start, then sets velocity and pressure where the particles are.
// Errors: scene_invalid where an expression is not finite.
proto::Status set_start(const proto::SceneDesc& scene, solver::Model& model, const solver::Surroundings& surroundings,
                        solver::Particles& particles, const FluidFiles& files = {});

}  // namespace headrace::scene
