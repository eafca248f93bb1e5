// What a model is: the numerical method that advances the particles by a step.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "server/solver/objects.h"
#include "server/solver/parameters.h"
#include "server/solver/particles.h"
#include "server/solver/step_report.h"

namespace headrace::solver {

// What a step sees besides the particles. Objects may differ from step to step.
struct Surroundings {
    std::span<const CollisionObject> objects;  // in the scene's order
    Domain domain;
};

// Owner: the simulation thread. Its step uses the OpenMP team of the calling thread.
class Model {
  public:
    virtual ~Model() = default;

    virtual std::string_view name() const = 0;

    // Makes the state complete at t = 0 from x and v: density, pressure, acceleration, leap velocity (2.35).
    // A fault here means the scene starts outside its domain or non-finite.
    virtual StepReport initialise(Particles& particles, const Surroundings& surroundings) = 0;

    virtual StepReport step(Particles& particles, const Surroundings& surroundings) = 0;

    virtual double time_step() const = 0;                  // [s] of the next step
    virtual std::string_view time_step_limit() const = 0;  // "fixed", or the criterion that limits it
    virtual double particle_mass() const = 0;              // [kg] (2D: kg/m)
    virtual Vec3 gravity() const = 0;                      // [m/s^2]

    virtual const std::vector<ParameterInfo>& parameter_table() const = 0;
    virtual ParameterMap parameters() const = 0;
    // All or none; takes effect at the next step.
    virtual std::optional<ParameterError> set_parameters(const ParameterMap& values) = 0;

    // The stages of a step in their order, skipped ones included, with the time spent in each.
    virtual std::vector<Stage> plan(const Surroundings& surroundings) const = 0;
};

}  // namespace headrace::solver
