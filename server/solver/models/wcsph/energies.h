// Where the fluid's energy goes, counted term by term from the discrete step, not from formulas of the continuum.
//
// A kick of length tau changes the kinetic energy by sum_i m_i tau a_i . (v_i + tau/2 a_i), exactly, so each term k of
// the acceleration did the work sum_i m_i tau a_k,i . (v_i + tau/2 a_i). Of this
//
//   work        body forces; gravity along periodic axes, where it has no potential; surface tension, whose energy is
//               none of the three; moving walls: force of each dummy on the fluid times the dummy's velocity
//   dissipated  minus the work of artificial and physical viscosity, less what moving no-slip walls put in
//               minus what density diffusion adds to the internal energy
//               minus what shifting and putting back at walls change in all three energies
//   balance     what is left: pressure exchanges kinetic and internal energy, gravity kinetic and potential energy, and
//               the scheme does so up to its errors in time, of fixed corrections and of the walls' pressure
//
// Nothing is computed unless the energies are followed, and following them changes no bit of the run.
#pragma once

#include <algorithm>
#include <vector>

#include "server/solver/energy_budget.h"
#include "server/solver/eos.h"
#include "server/solver/models/wcsph/loads.h"
#include "server/solver/models/wcsph/state.h"
#include "server/solver/objects.h"

namespace headrace::solver {

struct StoredEnergy {
    double kinetic{}, potential{}, internal{};  // [J] (2D: J/m)
    double total() const { return kinetic + potential + internal; }
};

// What the stored energies depend on besides the particles.
struct EnergySetting {
    Vec3 gravity{};         // [m/s^2] along the axes where it has a potential
    double rest_density{};  // [kg/m^3]
    StateEquation eos;
};

EnergySetting make_energy_setting(const Vec3& gravity, const Domain& domain, double rest_density,
                                  const StateEquation& eos);

StoredEnergy compute_stored_energy(const Particles& particles, const std::vector<double>& delta,
                                   const EnergySetting& setting);

// Owner: the model, which calls it at each of the step's stages while it is on.
class EnergyAccount {
  public:
    void follow(bool on);
    bool is_on() const { return is_on_; }
    bool has_started() const { return has_started_; }

    // Counting begins: after the step's slow forces, before its first kick.
    void start(double stored);

    // The account in the state (particles, stored).
    EnergyBudget budget(const StoredEnergy& stored) const;

    // After the sort of the particles.
    void permute(const ClusterOrder& order, std::vector<double>& scratch);

    // Slow forces. `a`: sum so far, with gravity and body force; then with viscosity, too.
    void note_body_force(const VectorField& a, const EnergySetting& setting, int dimensions);
    void note_viscosity(const VectorField& a, int dimensions);
    void note_tension(const VectorField& a, int dimensions);  // with surface tension, too
    // Accelerations without and with artificial viscosity.
    void note_without_artificial(const VectorField& a) { artificial_ = a; }
    void note_no_artificial() {
        for (std::vector<double>& component : artificial_) std::fill(component.begin(), component.end(), 0.0);
    }
    void note_with_artificial(const VectorField& a, int dimensions);
    // Of moving walls [W].
    void note_wall_pressure(double power) { wall_pressure_power_ = power; }
    void note_wall_viscosity(double power) { wall_viscosity_power_ = power; }

    // Before the velocities change by tau a.
    void count_kick(const Particles& particles, double tau);

    // Rates of delta without diffusion; then, after delta += dt rate, with.
    void note_without_diffusion(const std::vector<double>& rate) { rate_without_diffusion_ = rate; }
    void count_diffusion(const Particles& particles, const WcsphState& state, const EnergySetting& setting, double dt);

    // Stored energy before and after what is neither force nor compression.
    void count_loss(double before, double after) { dissipated_ += before - after; }

  private:
    bool is_on_{false};
    bool has_started_{false};
    double start_{};                              // [J] stored when counting began
    double dissipated_{}, work_{};                // [J] since
    double wall_pressure_power_{};                // [W]
    double wall_viscosity_power_{};               // [W]
    VectorField body_;                            // [m/s^2] of all that counts as work
    VectorField slow_before_;                     // [m/s^2] scratch: slow forces so far
    VectorField viscosity_;                       // [m/s^2]
    VectorField artificial_;                      // [m/s^2]; empty without it
    std::vector<double> rate_without_diffusion_;  // [1/s]
};

}  // namespace headrace::solver
