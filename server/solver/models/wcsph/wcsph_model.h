// The wcsph model's class, private to this folder: wcsph.h tells the method, wcsph.cpp starts it, wcsph_step.cpp steps,
// wcsph_report.cpp tells about it.
#pragma once

#include <array>
#include <chrono>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "server/solver/eos.h"
#include "server/solver/models/wcsph/energies.h"
#include "server/solver/models/wcsph/health.h"
#include "server/solver/models/wcsph/inspection.h"
#include "server/solver/models/wcsph/loads.h"
#include "server/solver/models/wcsph/parameters.h"
#include "server/solver/models/wcsph/sight_lines.h"
#include "server/solver/models/wcsph/step_criteria.h"
#include "server/solver/models/wcsph/sums.h"
#include "server/solver/models/wcsph/wall_field.h"
#include "server/solver/models/wcsph/wcsph.h"

namespace headrace::solver {

enum WcsphStage {
    kNeighbours,
    kGeometry,
    kShifting,
    kGravity,
    kBodyForce,
    kViscosity,
    kTension,
    kContinuity,
    kWalls,
    kWallMotion,
    kPressure,
    kAdvance,
    kCheck,
    kStageCount
};

// Colour gradient times support from which the thesis's particles are surface: 7.065/m 0.0457 m.
inline constexpr double kThesisThreshold = 0.3229;

class Wcsph final : public Model {
  public:
    Wcsph(int dimensions, double spacing, const ParameterMap& overrides)
        : dimensions_(dimensions),
          spacing_(spacing),
          table_(wcsph_parameter_table(dimensions, spacing)),
          overrides_(overrides),
          p_(make_wcsph_parameters(overrides)),
          support_(p_.support_over_spacing * spacing),
          walls_(dimensions, spacing, support_) {
        make_sums();
    }

    std::string_view name() const override { return "wcsph"; }

    void relax(Particles& particles, const Surroundings& surroundings, const std::vector<bool>& spread) override;
    void prepare(Particles& particles, const Surroundings& surroundings) override;
    StepReport initialise(Particles& particles, const Surroundings& surroundings) override;
    StepReport step(Particles& particles, const Surroundings& surroundings) override;

    double time_step() const override { return next_.dt; }
    std::string_view time_step_limit() const override { return next_.criterion; }
    double hydrostatic_pressure(double weight) const override { return eos_.hydrostatic_pressure(weight); }
    double particle_mass() const override { return p_.rest_density * std::pow(spacing_, dimensions_); }
    double rest_density() const override { return p_.rest_density; }
    double support_radius() const override { return support_; }
    Vec3 gravity() const override { return p_.gravity; }
    const std::vector<ParameterInfo>& parameter_table() const override { return table_; }
    ParameterMap parameters() const override;
    std::optional<ParameterError> set_parameters(const ParameterMap& values) override;
    std::vector<Stage> plan(const Surroundings& surroundings) const override;
    std::string strategy() const override;
    std::optional<std::string> refuse_object(const CollisionObject&) const override { return std::nullopt; }
    std::optional<std::string> refuse_domain(const Domain& domain) const override;
    std::optional<std::string> refuse_objects(std::span<const CollisionObject> objects, const Domain& domain,
                                              double t) const override;

    std::vector<ObjectLoad> object_loads(const Particles& particles, const Surroundings& surroundings) const override;
    void follow_energies(bool on) override { energies_.follow(on); }
    std::optional<EnergyBudget> energies(const Particles& particles, const Surroundings& surroundings) const override;
    std::optional<ParticleInspection> inspect(const Particles& particles, const Surroundings& surroundings,
                                              Index id) const override;

  private:
    // Ways [spacings] that lists reach beyond the support, when they are made and when they are pruned. The longer, the
    // rarer that is done and the more pairs out of reach the loops meet. Skins of 0.4 to 1.2 and inner ones of 0.05 to
    // 0.3 were tried in dam breaks: those around these are within 3 % of each other.
    double skin() const { return dimensions_ == 2 ? 1.0 : 0.6; }
    double inner_skin() const { return dimensions_ == 2 ? 0.3 : 0.2; }
    // Fluid slides along walls further than past other fluid, and few particles see one. Not beyond half a period.
    double wall_skin() const { return std::min(2.0 * skin(), (1.45 * period_unit() - support_) / spacing_); }

    template <class Work>
    void timed(WcsphStage stage, Work&& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        seconds_[stage] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    double h() const { return 0.5 * support_; }
    // Periods are three times as long, at least: two particles see each other under one image only while a period is
    // longer than twice what the lists reach.
    double period_unit() const { return support_ + (dimensions_ == 2 ? 0.8 : 0.6) * spacing_; }
    // alpha h c0 rho0 [Pa s], less what the fluid's own viscosity does for it: alpha h c0 equals a kinematic viscosity
    // alpha h c0/(2 (D + 2)).
    double artificial_viscosity() const {
        return std::max(
            0.0, p_.artificial_viscosity * h() * c0_ * p_.rest_density - 2.0 * (dimensions_ + 2.0) * p_.viscosity);
    }
    bool is_adjoint() const {
        return p_.pressure_gradient == PressureGradient::adjoint || p_.pressure_gradient == PressureGradient::plain ||
               (p_.pressure_gradient == PressureGradient::automatic && p_.free_surface);
    }
    // Fourtakas takes still water for granted: wrong in free fall, and better than Antuono where none is possible.
    DensityDiffusion diffusion() const {
        if (p_.density_diffusion_factor <= 0.0) return DensityDiffusion::none;
        switch (p_.density_diffusion) {
            case DiffusionForm::none:
                return DensityDiffusion::none;
            case DiffusionForm::molteni_colagrossi:
                return DensityDiffusion::molteni_colagrossi;
            case DiffusionForm::fourtakas:
                return DensityDiffusion::fourtakas;
            case DiffusionForm::antuono:
                return DensityDiffusion::antuono;
            case DiffusionForm::automatic:
                break;
        }
        return p_.free_surface ? DensityDiffusion::antuono : DensityDiffusion::fourtakas;
    }
    bool has_shifting() const { return p_.shifting && p_.shifting_factor > 0.0 && p_.shifting_limit > 0.0; }
    bool is_morris() const {
        return p_.viscosity_form == ViscosityForm::morris ||
               (p_.viscosity_form == ViscosityForm::automatic && !p_.free_surface);
    }
    double least_wall_pressure() const {
        const bool clamps =
            p_.wall_suction == WallSuction::clamped || (p_.wall_suction == WallSuction::automatic && p_.free_surface);
        return clamps ? 0.0 : -std::numeric_limits<double>::infinity();
    }
    static FieldView volumes(const Particles& particles) { return FieldView::quotient(particles.m, particles.rho); }
    // Surface tension asks for the fluid's places in the walls, too: it takes dummies.
    WallOptions wall_options() const {
        const bool may = p_.surface_tension == 0.0;
        return {p_.gravity, p_.wall_slip, may && p_.walls == WallKind::integrals,
                may && p_.walls == WallKind::automatic};
    }
    SolidView solid_view() const {
        if (walls_.integrals().is_empty()) return {};
        SolidView view;
        view.walls = &walls_.integrals();
        view.gravity = p_.gravity;
        view.a_body = wall_gravity_[0].empty() ? nullptr : &wall_gravity_;
        view.inv_c2 = 1.0 / (c0_ * c0_);
        view.walls_suck = least_wall_pressure() < 0.0;
        view.inner_low = view.walls->inner_low();
        view.inner_high = view.walls->inner_high();
        view.has_obstacles = view.walls->has_obstacles();
        return view;
    }
    PassData data(Particles& particles) {
        return {particles, state_, walls_.particles(), walls_.state(), solid_view()};
    }

    WcsphView view(const Particles& particles) const {
        return {particles, state_, walls_.particles(), walls_.state(), solid_view()};
    }
    // Of the pressure pass in the present state.
    SolidSums record_solid_sums(const Particles& particles) const;
    PressureOptions pressure_options() const;
    int artificial_weight(int k) const;
    ViscosityOptions viscosity_options() const { return {p_.viscosity, 0.25 * spacing_}; }
    TensionOptions tension_options() const { return {p_.surface_tension, flat_surface_, kThesisThreshold / support_}; }
    TermOptions term_options() const;
    std::string walls_reason() const;
    EnergySetting energy_setting(const Surroundings& surroundings) const {
        return make_energy_setting(p_.gravity, surroundings.domain, p_.rest_density, eos_);
    }
    double stored_energy(const Particles& particles, const Surroundings& surroundings) const {
        return compute_stored_energy(particles, state_.delta, energy_setting(surroundings)).total();
    }
    WallPower wall_power(const Particles& particles, const Surroundings& surroundings) const;
    void start_energies(Particles& particles, const Surroundings& surroundings);
    // What `work` changes in the stored energy counts as dissipated.
    template <class Work>
    void count_loss(const Particles& particles, const Surroundings& surroundings, Work&& work) {
        const double before = energies_.is_on() ? stored_energy(particles, surroundings) : 0.0;
        work();
        if (energies_.is_on()) energies_.count_loss(before, stored_energy(particles, surroundings));
    }

    SectionKernel section_kernel() const;  // for the walls, while sums_ lives
    // Of the kernel, support and precision of now; the neighbours are not known yet.
    void make_sums();
    void set_flat_surface() {
        const auto W = [this](double r) { return sums_->W(r); };
        flat_surface_ = dimensions_ == 2 ? make_flat_surface<2>(W, support_) : make_flat_surface<3>(W, support_);
    }
    void set_state_equation();
    void use_new_parameters(Particles& particles, const Surroundings& surroundings);
    StepChoice limit_step(double dt_before) const;
    RunLimits run_limits() const;
    void resize_state(std::size_t count);
    // Into particles.a, and nothing else: what the sound speed's rule reads.
    void put_body_force(Particles& particles, const Surroundings& surroundings);
    void put_in_order(Particles& particles, const Surroundings& surroundings);
    void sort_all(Particles& particles, const Surroundings& surroundings);
    void list_neighbours(const Particles& particles, const Surroundings& surroundings);
    // Before any sums: the lists must cover the places of now. Sorts where they do not.
    void find_neighbours(Particles& particles, const Surroundings& surroundings);
    LoadInput load_input(const Surroundings& surroundings) const {
        return {neighbours_.get(), surroundings.domain, support_, walls_.thin_walls()};
    }
    void wrap(Particles& particles, const Domain& domain) const;
    void place_walls(const Surroundings& surroundings, double t, bool anew);
    GeometryOptions geometry_options(bool shifts) const;
    void compute_geometry(Particles& particles, bool shifts);
    void apply_shift(Particles& particles, double share);
    void compute_slow_forces(Particles& particles, const Surroundings& surroundings);
    void add_body_force(const Particles& particles, const Surroundings& surroundings);
    void compute_tension(Particles& particles, const Surroundings& surroundings);
    void look_ahead(const Particles& particles);
    void compute_state(Particles& particles, double dt, double drift);
    void compute_pressure_forces(Particles& particles, const Surroundings& surroundings);
    void compute_pressure(Particles& particles, const Surroundings& surroundings);
    void kick_drift(Particles& particles, double kick, double drift);
    void acoustic_step(Particles& particles, const Surroundings& surroundings, double t, double dt);
    StepReport finish(Particles& particles, const Surroundings& surroundings, double dt);

    int dimensions_;
    double spacing_;  // [m]
    std::vector<ParameterInfo> table_;
    ParameterMap overrides_;
    WcsphParameters p_;
    double support_;  // R [m]
    StateEquation eos_;
    double c0_{};  // [m/s]

    ClusterOrder order_;
    WallField walls_;
    std::unique_ptr<PairNeighbours> neighbours_;
    std::string isa_;           // of the pair loops
    bool has_lists_{false};     // in the order of now
    bool is_first_list_{true};  // of these neighbours
    SightLines among_fluid_, fluid_to_wall_, wall_to_fluid_;
    std::uint64_t objects_version_{~std::uint64_t{0}};
    WcsphState state_;
    Particles midpoint_;  // x, v where the body force is evaluated; empty without one
    std::unique_ptr<WcsphSums> sums_;
    FlatSurface flat_surface_;  // under this kernel
    VectorField wall_gravity_;  // [m/s^2] gravity and body force, for integral walls; empty without either
    VectorField tension_x_;     // [m] where surface tension is evaluated; empty without it
    Vec3 period_{};             // [m]

    double max_speed_{}, max_acceleration_{};  // [m/s], [m/s^2] at the end of the last step
    bool has_new_parameters_{false};
    bool has_new_stiffness_{false};  // among them what the sound speed's rule depends on
    EnergyAccount energies_;
    std::vector<std::string> object_names_;  // of the walls' objects
    std::uint64_t step_{};
    std::uint64_t put_back_{};   // particles put back on a wall's surface so far
    std::uint64_t separated_{};  // coincident pairs, so far
    std::uint64_t sorts_{};      // so far
    StepChoice next_;
    int artificial_weight_{1};  // of the last pressure force
    std::array<double, kStageCount> seconds_{};
};

}  // namespace headrace::solver
