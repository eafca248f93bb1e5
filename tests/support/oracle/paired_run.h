// The fast thesis model and its oracle side by side, from the same particles, objects and parameters.
#pragma once

#include <memory>
#include <vector>

#include "server/solver/model.h"
#include "tests/support/oracle/thesis_oracle.h"

namespace headrace::oracle {

// A block of particles on a lattice, centres at min + (k + 1/2) spacing, and what surrounds it.
struct Setup {
    int dimensions{3};
    double spacing{};             // [m]
    std::array<int, 3> counts{};  // particles per axis (2D: the third is 1)
    Vec3 min{};                   // [m] lower corner of the block
    Vec3 velocity{};              // [m/s]
    std::vector<solver::CollisionObject> objects;
    solver::Domain domain;
    solver::ParameterMap overrides;
};

std::vector<Vec3> make_lattice(const Setup& setup);

// Scenes of the validation: spacing of the thesis, (0.02/998.29)^(1/3) m, unless said otherwise.
Setup small_dam_break();     // 10 x 10 x 10 in a corner of a tank three times as long
Setup bowl();                // 13 x 13 x 13 falling into a sphere of 0.4 m
Setup flat_dam_break();      // 2D, 20 x 40, spacing 0.0136 m
Setup obstacle_dam_break();  // the small dam break against a sphere, a block and a thin plate
Setup column();              // 10 x 20 x 15 in a box of its own footprint; half the thesis's time step

// The fast model alone.
class FastRun {
  public:
    explicit FastRun(const Setup& setup);
    void step();  // throws std::runtime_error on a fault

    solver::Model& model() { return *model_; }
    const solver::Particles& particles() const { return particles_; }

  private:
    Setup setup_;
    std::unique_ptr<solver::Model> model_;
    solver::Particles particles_;
};

ThesisOracle make_oracle(const Setup& setup, const solver::ParameterMap& parameters);

// The largest differences between the two, over all particles matched by id and all components.
struct Deviation {
    double x{};       // [spacings]
    double v{};       // relative to the largest speed
    double v_half{};  // relative to the largest speed
    double a{};       // relative to the largest acceleration
    double rho{};     // relative to the largest density
    double p{};       // relative to the largest pressure
};

Deviation compute_deviation(const solver::Particles& fast, const ThesisOracle& oracle, double spacing);

// Whole-field figures of a run.
struct Statistics {
    double front{};         // [m] largest x
    double mean_density{};  // [kg/m^3]
    double energy{};        // [J] kinetic and potential, potential counted from y = 0 (2D: per metre)
};

Statistics compute_statistics(const solver::Particles& particles, double m, double g);
Statistics compute_statistics(const ThesisOracle& oracle, double m, double g);

}  // namespace headrace::oracle
