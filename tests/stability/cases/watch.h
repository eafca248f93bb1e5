// Follows a run and takes each criterion's largest value. Value and bound of each:
//
//   lost          particles gone, or a change of the total mass; 0: no term creates or removes either
//   leak          deepest place behind a surface, in spacings; 0.1: particles are put back on surfaces once a step, and
//                 walls that move go on meanwhile
//   energy        growth of kinetic + potential + internal - work beyond the start's, in (largest kinetic + internal)
//                 + m g H; 0.05: every term takes energy, errors of the scheme give some back
//   momentum      change beyond gravity's, in mass * largest speed; 0.02: pairs conserve it, shifting does not
//   step          1e-3 first step / shortest step; 1
//   density       largest |rho/rho0 - 1|; 0.3: three times the water hammer |v|/c0 = 0.1 of a flat impact
//   mean_density  mean of the same beyond that of the start; 0.05: half the water hammer
//   distance      0.3 spacing / 1 % quantile of the nearest distances inside the fluid; 1: the pressure force of a pair
//                 is largest at a quarter of the support and has lost a third there
//
// Non-finite numbers are the model's own criterion, as is the domain.
#pragma once

#include <optional>
#include <vector>

#include "tests/stability/cases/scenario.h"

namespace headrace::stability {

class Watch {
  public:
    Watch(const Scenario& scenario, const scene::Run& run);

    void note_disturbance() { is_disturbed_ = true; }
    void note_step(const scene::Run& run);  // cheap: after every step
    void sample(const scene::Run& run);     // all criteria
    std::vector<Criterion> criteria() const;

  private:
    void start_anew(const scene::Run& run);
    void sample_energy(const scene::Run& run);
    void sample_momentum(const scene::Run& run);
    void sample_leaks(const scene::Run& run);
    void sample_density(const scene::Run& run);

    const Scenario& scenario_;
    bool is_disturbed_{false};
    std::size_t count_{};
    double mass_{};                     // [kg] at the start
    double rest_density_{};             // [kg/m^3] then
    double first_step_{}, shortest_{};  // [s]
    double energy_then_{};              // [J] stored at the start or after the last disturbance, work taken off
    double largest_stored_{};           // [J] kinetic + internal
    double largest_speed_{};            // [m/s]
    solver::Vec3 momentum_{};           // [kg m/s]
    double momentum_time_{};            // [s]
    std::optional<double> mean_then_;   // [1] of |rho/rho0 - 1| when first judged
    double lost_{}, leak_{}, energy_{}, drift_{}, step_{}, density_{}, mean_density_{}, distance_{};
};

// Of the distances of each particle to its nearest neighbour the one that the share q of the particles is below [m].
// Only particles inside the fluid count: with three quarters of the neighbours within 2 spacings that a square or cubic
// lattice has. +infinity: there are none.
double nearest_distance(const solver::Particles& particles, const solver::Domain& domain, double spacing, double q);

}  // namespace headrace::stability
