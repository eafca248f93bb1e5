// What a model is: the numerical method that advances the particles by a step.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/solver/energy_budget.h"
#include "server/solver/objects.h"
#include "server/solver/parameters.h"
#include "server/solver/particle_inspection.h"
#include "server/solver/particles.h"
#include "server/solver/step_report.h"

namespace headrace::solver {

// Acceleration of the surroundings on the fluid beside the model's own gravity [m/s^2]: adds to a[axis][i].
using BodyForce = std::function<void(double t, const Particles& particles, VectorField& a)>;

// What a step sees besides the particles. Objects may differ from step to step.
struct Surroundings {
    std::span<const CollisionObject> objects;  // in the scene's order
    Domain domain;
    double time{0.0};                  // [s] at the start of the step
    const BodyForce* body_force{};     // null: none
    std::uint64_t objects_version{0};  // changes whenever an object was added, moved, removed
};

// What the fluid does to an object: force [N] (2D: N/m), torque about the origin [N m] (2D: N).
struct ObjectLoad {
    Vec3 force{};
    Vec3 torque{};
};

// Owner: the simulation thread. Its step uses the OpenMP team of the calling thread.
class Model {
  public:
    virtual ~Model() = default;

    virtual std::string_view name() const = 0;

    // Makes the state complete at t = 0 from id, x, v and p (the pressure wished for; a model may ignore it): mass,
    // density, pressure, acceleration. A fault here means the scene starts outside its domain or non-finite.
    virtual StepReport initialise(Particles& particles, const Surroundings& surroundings) = 0;

    virtual StepReport step(Particles& particles, const Surroundings& surroundings) = 0;

    // Spreads the particles evenly before initialise(), without moving the fluid as a whole. Does nothing in models
    // that do not need it. `spread[i]`: may particle i move?
    virtual void relax(Particles& particles, const Surroundings& surroundings, const std::vector<bool>& spread);

    // Before initialise(), when x and v are known: fixes what follows from the scene as a whole (the speed of sound).
    virtual void prepare(Particles& particles, const Surroundings& surroundings);

    // [Pa] in still fluid under gravity where the incompressible column above weighs rho0 g d = `weight` [Pa].
    virtual double hydrostatic_pressure(double weight) const { return weight; }

    virtual double time_step() const = 0;                  // [s] of the next step
    virtual std::string_view time_step_limit() const = 0;  // "fixed", or the criterion that limits it
    virtual double particle_mass() const = 0;              // [kg] (2D: kg/m) of a particle at rest density
    virtual double rest_density() const = 0;               // [kg/m^3]
    virtual double support_radius() const = 0;             // [m]
    virtual Vec3 gravity() const = 0;                      // [m/s^2]

    virtual const std::vector<ParameterInfo>& parameter_table() const = 0;
    virtual ParameterMap parameters() const = 0;
    // All or none; takes effect at the next step.
    virtual std::optional<ParameterError> set_parameters(const ParameterMap& values) = 0;

    // How pairs are summed: strategy, precision, instruction set. Where it differs, so may the last bits of a run.
    virtual std::string strategy() const = 0;

    // The stages of a step in their order, skipped ones included, with the time spent in each.
    virtual std::vector<Stage> plan(const Surroundings& surroundings) const = 0;

    // Why the model cannot work with this object, this domain, a body force; nothing when it can.
    virtual std::optional<std::string> refuse_object(const CollisionObject& object) const = 0;
    virtual std::optional<std::string> refuse_domain(const Domain& domain) const = 0;
    virtual std::optional<std::string> refuse_body_force() const { return std::nullopt; }
    // All objects of the scene together, placed as at time t [s]: do they ask for more than there is room for?
    virtual std::optional<std::string> refuse_objects(std::span<const CollisionObject> /*objects*/,
                                                      const Domain& /*domain*/, double /*t*/) const {
        return std::nullopt;
    }

    // ---- what probes ask for; computed on demand, at the state the last step left ----------------------------------

    // One per object; empty when the model cannot tell.
    virtual std::vector<ObjectLoad> object_loads(const Particles& particles, const Surroundings& surroundings) const;

    // From now on the energies are followed (or no longer); costs time only while on. Empty budget: cannot tell.
    virtual void follow_energies(bool on);
    virtual std::optional<EnergyBudget> energies(const Particles& particles, const Surroundings& surroundings) const;

    // Neighbours of the particle with this id and the acceleration of each term on it; empty: cannot tell.
    virtual std::optional<ParticleInspection> inspect(const Particles& particles, const Surroundings& surroundings,
                                                      Index id) const;
};

}  // namespace headrace::solver
