#include "server/solver/models/wcsph/wcsph.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "server/solver/eos.h"
#include "server/solver/faults.h"
#include "server/solver/models/wcsph/coincident.h"
#include "server/solver/models/wcsph/energies.h"
#include "server/solver/models/wcsph/health.h"
#include "server/solver/models/wcsph/inspection.h"
#include "server/solver/models/wcsph/loads.h"
#include "server/solver/models/wcsph/parameters.h"
#include "server/solver/models/wcsph/sound_speed.h"
#include "server/solver/models/wcsph/step_criteria.h"
#include "server/solver/models/wcsph/sums.h"
#include "server/solver/models/wcsph/wall_field.h"
#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

enum StageIndex { kNeighbours, kGeometry, kSlow, kContinuity, kWalls, kPressure, kAdvance, kCheck, kStageCount };

// Colour gradient times support from which the thesis's particles are surface: 7.065/m 0.0457 m.
constexpr double kThesisThreshold = 0.3229;

class Wcsph final : public Model {
  public:
    Wcsph(int dimensions, double spacing, const ParameterMap& overrides)
        : dimensions_(dimensions),
          spacing_(spacing),
          table_(wcsph_parameter_table(dimensions, spacing)),
          overrides_(overrides),
          p_(make_wcsph_parameters(overrides)),
          support_(p_.support_over_spacing * spacing),
          walls_(dimensions, spacing, support_),
          sums_(make_wcsph_sums(dimensions, p_.kernel, support_, best_isa())) {
        set_flat_surface();
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
    std::string walls_reason() const;
    std::optional<std::string> refuse_object(const CollisionObject&) const override { return std::nullopt; }
    std::optional<std::string> refuse_domain(const Domain& domain) const override;

    std::vector<ObjectLoad> object_loads(const Particles& particles, const Surroundings& surroundings) const override;
    void follow_energies(bool on) override { energies_.follow(on); }
    std::optional<EnergyBudget> energies(const Particles& particles, const Surroundings& surroundings) const override;
    std::optional<ParticleInspection> inspect(const Particles& particles, const Surroundings& surroundings,
                                              Index id) const override;

  private:
    static constexpr double kSkin = 0.5;  // [spacings] by which cells are wider than the support

    template <class Work>
    void timed(StageIndex stage, Work&& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        seconds_[stage] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    double h() const { return 0.5 * support_; }
    // alpha h c0 rho0 [Pa s], less what the fluid's own viscosity does for it: alpha h c0 equals a kinematic viscosity
    // alpha h c0/(2 (D + 2)).
    double artificial_viscosity() const {
        return std::max(
            0.0, p_.artificial_viscosity * h() * c0_ * p_.rest_density - 2.0 * (dimensions_ + 2.0) * p_.viscosity);
    }
    double cell_side() const { return support_ + kSkin * spacing_; }
    bool is_adjoint() const {
        return p_.pressure_gradient == PressureGradient::adjoint || p_.pressure_gradient == PressureGradient::plain ||
               (p_.pressure_gradient == PressureGradient::automatic && p_.free_surface);
    }
    bool is_morris() const {
        return p_.viscosity_form == ViscosityForm::morris ||
               (p_.viscosity_form == ViscosityForm::automatic && !p_.free_surface);
    }
    double least_wall_pressure() const {
        const bool clamps =
            p_.wall_suction == WallSuction::clamped || (p_.wall_suction == WallSuction::automatic && p_.free_surface);
        return clamps ? 0.0 : -std::numeric_limits<double>::infinity();
    }
    PassData data(Particles& particles) { return {particles, state_, walls_.particles(), walls_.state()}; }

    WcsphView view(const Particles& particles) const { return {particles, state_, walls_.particles(), walls_.state()}; }
    PressureOptions pressure_options() const;
    ViscosityOptions viscosity_options() const { return {p_.viscosity, 0.25 * spacing_}; }
    TensionOptions tension_options() const { return {p_.surface_tension, flat_surface_, kThesisThreshold / support_}; }
    TermOptions term_options() const;
    EnergySetting energy_setting(const Surroundings& surroundings) const {
        return make_energy_setting(p_.gravity, surroundings.domain, p_.rest_density, eos_);
    }
    double stored_energy(const Particles& particles, const Surroundings& surroundings) const {
        return compute_stored_energy(particles, state_.delta, energy_setting(surroundings)).total();
    }
    WallPower wall_power(const Particles& particles) const;
    void start_energies(Particles& particles, const Surroundings& surroundings);
    // What `work` changes in the stored energy counts as dissipated.
    template <class Work>
    void count_loss(const Particles& particles, const Surroundings& surroundings, Work&& work) {
        const double before = energies_.is_on() ? stored_energy(particles, surroundings) : 0.0;
        work();
        if (energies_.is_on()) energies_.count_loss(before, stored_energy(particles, surroundings));
    }

    void set_flat_surface() {
        const auto W = [this](double r) { return sums_->W(r); };
        flat_surface_ = dimensions_ == 2 ? make_flat_surface<2>(W, support_) : make_flat_surface<3>(W, support_);
    }
    void set_state_equation();
    void use_new_parameters(Particles& particles, const Surroundings& surroundings);
    StepChoice limit_step(double dt_before) const;
    RunLimits run_limits() const;
    void resize_state(std::size_t count);
    void sort_all(Particles& particles, const Surroundings& surroundings);
    void wrap(Particles& particles, const Domain& domain) const;
    void place_walls(const Surroundings& surroundings, double t, bool anew);
    PairInput pair_input(const Particles& particles, bool centres_are_walls) const;
    GeometryOptions geometry_options(bool shifts) const;
    void compute_geometry(Particles& particles, bool shifts);
    void apply_shift(Particles& particles, double share);
    void compute_slow_forces(Particles& particles, const Surroundings& surroundings);
    void compute_tension(Particles& particles);
    void compute_state(Particles& particles, double dt, double drift);
    void compute_pressure_forces(Particles& particles);
    void compute_pressure(Particles& particles);
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

    CellGrid grid_;
    WallField walls_;
    std::uint64_t objects_version_{~std::uint64_t{0}};
    WcsphState state_;
    Particles midpoint_;  // where the body force is evaluated; empty without one
    std::unique_ptr<WcsphSums> sums_;
    FlatSurface flat_surface_;  // under this kernel
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
    double moved_{};             // [m] at most, since the last sort
    StepChoice next_;
    std::array<double, kStageCount> seconds_{};
    std::vector<double> scratch_;
    std::vector<Index> scratch_id_;
};

// ---- start ----------------------------------------------------------------------------------------------------------

void Wcsph::set_state_equation() {
    eos_ = {p_.rest_density * c0_ * c0_, p_.state_equation == StateEquationKind::tait ? 7.0 : 1.0};
}

void Wcsph::resize_state(std::size_t count) {
    for (std::vector<double>* field :
         {&state_.delta, &state_.min_eigenvalue, &state_.ddelta, &state_.V, &state_.delta_rate})
        field->assign(count, 0.0);
    for (VectorField* field : {&state_.normal, &state_.grad_delta, &state_.dx, &state_.dv, &state_.a_slow})
        for (int k = 0; k < dimensions_; ++k) (*field)[k].assign(count, 0.0);
    for (MatrixField* field : {&state_.B, &state_.pB, &state_.strain})
        for (int k = 0; k < symmetric_size(dimensions_); ++k) (*field)[k].assign(count, 0.0);
}

void Wcsph::prepare(Particles& particles, const Surroundings& surroundings) {
    for (int k = 0; k < 3; ++k) {
        particles.v_half[k].clear();
        period_[k] = surroundings.domain.max[k] - surroundings.domain.min[k];
        std::fill(particles.a[k].begin(), particles.a[k].end(), 0.0);
    }
    if (surroundings.body_force != nullptr) (*surroundings.body_force)(surroundings.time, particles, particles.a);
    place_walls(surroundings, surroundings.time, true);
    c0_ = choose_sound_speed(p_, particles, spacing_, walls_.max_speed());
    set_state_equation();
}

// Shifting alone, until the particles have settled. Along a free surface they move sideways only, so its shape stays.
void Wcsph::relax(Particles& particles, const Surroundings& surroundings, const std::vector<bool>& spread) {
    constexpr int kMostTurns = 500;
    constexpr double kSettled = 1e-3;  // [spacings] largest shift of a turn
    prepare(particles, surroundings);
    resize_state(particles.size());
    std::fill(state_.V.begin(), state_.V.end(), std::pow(spacing_, dimensions_));
    std::vector<bool> may_move(spread);  // by id: sorting changes the slots
    for (std::size_t i = 0; i < particles.size(); ++i) may_move[particles.id[i]] = spread[i];
    GeometryOptions options = geometry_options(true);
    options.shift_factor = 0.5 * h() * h();
    options.shift_speed = 1.0;
    options.strain_length = 0.0;
    options.dynamic_pressure = 1.0;
    options.noise = 0.0;
    for (int turn = 0; turn < kMostTurns; ++turn) {
        sort_all(particles, surroundings);
        sums_->geometry(pair_input(particles, false), data(particles), options);
        double longest2 = 0.0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            if (!may_move[particles.id[i]]) continue;
            double shift2 = 0.0;
            for (int k = 0; k < dimensions_; ++k) {
                particles.x[k][i] += state_.dx[k][i];
                shift2 += state_.dx[k][i] * state_.dx[k][i];
            }
            longest2 = std::max(longest2, shift2);
        }
        if (std::sqrt(longest2) < kSettled * spacing_) break;
    }
    wrap(particles, surroundings.domain);
}

StepReport Wcsph::initialise(Particles& particles, const Surroundings& surroundings) {
    prepare(particles, surroundings);
    resize_state(particles.size());
    const double volume = std::pow(spacing_, dimensions_);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        state_.delta[i] = eos_.deviation(particles.p[i]);
        particles.m[i] = p_.rest_density * (1.0 + state_.delta[i]) * volume;
    }
    compute_state(particles, 0.0, 0.0);
    sort_all(particles, surroundings);
    compute_geometry(particles, false);
    compute_slow_forces(particles, surroundings);
    compute_pressure_forces(particles);
    return finish(particles, surroundings, 0.0);
}

// ---- neighbours and walls -------------------------------------------------------------------------------------------

void Wcsph::wrap(Particles& particles, const Domain& domain) const {
    for (int k = 0; k < dimensions_; ++k) {
        if (!domain.periodic[k]) continue;
        const double length = domain.max[k] - domain.min[k];
        parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                double& x = particles.x[k][i];
                if (x >= domain.min[k] && x < domain.max[k]) continue;
                x -= length * std::floor((x - domain.min[k]) / length);
                if (!(x < domain.max[k])) x = domain.min[k];
            }
        });
    }
}

void Wcsph::sort_all(Particles& particles, const Surroundings& surroundings) {
    wrap(particles, surroundings.domain);
    grid_.build(particles.x, particles.id, dimensions_, cell_side(), &surroundings.domain);
    grid_.permute(particles.id, scratch_id_);
    const auto permute = [&](std::vector<double>& field) { grid_.permute(field, scratch_); };
    for (VectorField* field : {&particles.x, &particles.v, &particles.a, &state_.normal, &state_.grad_delta,
                               &state_.a_slow, &state_.dx, &state_.dv})
        for (int k = 0; k < dimensions_; ++k) permute((*field)[k]);
    for (std::vector<double>* field : {&particles.m, &particles.rho, &particles.p, &state_.delta, &state_.V,
                                       &state_.min_eigenvalue, &state_.delta_rate, &state_.ddelta})
        permute(*field);
    for (MatrixField* field : {&state_.B, &state_.pB, &state_.strain})
        for (int k = 0; k < symmetric_size(dimensions_); ++k) permute((*field)[k]);
    if (energies_.is_on()) energies_.permute(grid_, scratch_);
    const std::uint64_t coincident = separate_coincident(particles, grid_, spacing_, step_);
    moved_ = coincident > 0 ? kCoincidentWay * spacing_ : 0.0;
    separated_ += coincident;
}

void Wcsph::place_walls(const Surroundings& surroundings, double t, bool anew) {
    walls_.place(surroundings, t, anew, {cell_side(), p_.gravity, p_.wall_slip});
    if (!anew) return;
    objects_version_ = surroundings.objects_version;
    object_names_.clear();
    for (const CollisionObject& object : surroundings.objects) object_names_.push_back(object.name);
}

PairInput Wcsph::pair_input(const Particles& particles, bool centres_are_walls) const {
    PairInput in;
    in.fluid = {&grid_, &particles.x, state_.V.data()};
    in.walls = walls_.points();
    in.centres = centres_are_walls ? in.walls : in.fluid;
    in.centres_are_walls = centres_are_walls;
    in.period = period_;
    in.support = support_;
    in.thin_walls = walls_.thin_walls();
    return in;
}

// ---- once per step --------------------------------------------------------------------------------------------------

GeometryOptions Wcsph::geometry_options(bool shifts) const {
    GeometryOptions options;
    options.correction_threshold = p_.pressure_gradient == PressureGradient::plain
                                       ? std::numeric_limits<double>::infinity()
                                   : is_adjoint() ? p_.correction_threshold
                                                  : 0.3;
    options.shifting = shifts;
    options.reconstructs =
        artificial_viscosity() > 0.0 && p_.artificial_viscosity_form == ArtificialViscosity::reconstructed;
    options.shift_factor = p_.shifting_factor * next_.dt * 2.0 * h();
    options.strain_length = kShiftStrainLength * h();
    options.W_dx = sums_->W(spacing_);
    options.dynamic_pressure = p_.rest_density * max_speed_ * max_speed_;
    options.noise = kShiftNoise * next_.dt;
    options.limits.longest = p_.shifting_limit * spacing_;
    if (!p_.free_surface) options.limits.surface_eigenvalue = options.limits.spray_eigenvalue = -1.0;
    return options;
}

void Wcsph::compute_geometry(Particles& particles, bool shifts) {
    GeometryOptions options = geometry_options(shifts);
    options.step = ++step_;
    sums_->geometry(pair_input(particles, false), data(particles), options);
}

// A share of the step's shift, and what it carries along.
void Wcsph::apply_shift(Particles& particles, double share) {
    parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (int k = 0; k < dimensions_; ++k) {
            for (std::size_t i = begin; i < end; ++i) {
                particles.x[k][i] += share * state_.dx[k][i];
                particles.v[k][i] += share * state_.dv[k][i];
            }
        }
        for (std::size_t i = begin; i < end; ++i) state_.delta[i] += share * state_.ddelta[i];
    });
    moved_ += share * p_.shifting_limit * spacing_;
}

void Wcsph::compute_slow_forces(Particles& particles, const Surroundings& surroundings) {
    for (int k = 0; k < dimensions_; ++k) std::fill(state_.a_slow[k].begin(), state_.a_slow[k].end(), p_.gravity[k]);
    if (surroundings.body_force != nullptr) {
        // At the middle of the step: held at its start, a spring would gain energy.
        const double half = 0.5 * next_.dt;
        midpoint_.dimensions = dimensions_;
        midpoint_.resize(particles.size());
        for (int k = 0; k < dimensions_; ++k) {
            parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t i = begin; i < end; ++i) {
                    midpoint_.v[k][i] = particles.v[k][i];
                    midpoint_.x[k][i] = particles.x[k][i] + half * particles.v[k][i];
                }
            });
        }
        (*surroundings.body_force)(surroundings.time + half, midpoint_, state_.a_slow);
    }
    if (energies_.is_on()) energies_.note_body_force(state_.a_slow, energy_setting(surroundings), dimensions_);
    if (p_.viscosity > 0.0) {
        sums_->viscosity(pair_input(particles, false), data(particles), is_morris(), viscosity_options());
        if (energies_.is_on()) {
            energies_.note_viscosity(state_.a_slow, dimensions_);
            energies_.note_wall_viscosity(wall_power(particles).viscosity);
        }
    }
    if (p_.surface_tension > 0.0) {
        compute_tension(particles);
        if (energies_.is_on()) energies_.note_tension(state_.a_slow, dimensions_);
    }
}

// On the positions that the step's force stands for: held at its start, the short capillary waves would gain energy.
void Wcsph::compute_tension(Particles& particles) {
    const double ahead = 0.5 * next_.dt * (1.0 + 1.0 / next_.acoustic_steps);
    for (int k = 0; k < dimensions_; ++k) {
        tension_x_[k].resize(particles.size());
        parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) tension_x_[k][i] = particles.x[k][i] + ahead * particles.v[k][i];
        });
    }
    for (int k = 0; k < symmetric_size(dimensions_); ++k) state_.surface_stress[k].resize(particles.size());
    PairInput in = pair_input(particles, false);
    in.fluid.x = in.centres.x = &tension_x_;
    if (p_.tension_form == TensionForm::continuum) {
        sums_->continuum_tension(in, data(particles), tension_options());
    } else {
        sums_->thesis_tension(in, data(particles), tension_options());
    }
}

// ---- acoustic steps -------------------------------------------------------------------------------------------------

void Wcsph::kick_drift(Particles& particles, double kick, double drift) {
    parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (int k = 0; k < dimensions_; ++k) {
            double *v = particles.v[k].data(), *x = particles.x[k].data();
            const double* a = particles.a[k].data();
            for (std::size_t i = begin; i < end; ++i) {
                v[i] += kick * a[i];
                x[i] += drift * v[i];
            }
        }
    });
}

// delta += dt rate, x += drift v; then everything that follows from delta.
void Wcsph::compute_state(Particles& particles, double dt, double drift) {
    const int components = symmetric_size(dimensions_);
    parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (int k = 0; k < dimensions_; ++k) {
            for (std::size_t i = begin; i < end; ++i) particles.x[k][i] += drift * particles.v[k][i];
        }
        for (std::size_t i = begin; i < end; ++i) {
            const double delta = state_.delta[i] += dt * state_.delta_rate[i];
            particles.rho[i] = p_.rest_density * (1.0 + delta);
            particles.p[i] = eos_.pressure(delta);
            state_.V[i] = particles.m[i] / particles.rho[i];
        }
        for (int c = 0; c < components; ++c) {
            for (std::size_t i = begin; i < end; ++i) state_.pB[c][i] = particles.p[i] * state_.B[c][i];
        }
    });
}

void Wcsph::compute_pressure_forces(Particles& particles) {
    compute_state(particles, 0.0, 0.0);
    if (!walls_.is_empty()) {
        timed(kWalls, [&] {
            sums_->wall_pressure(pair_input(particles, true), data(particles),
                                 {least_wall_pressure(), p_.rest_density * c0_ * c0_});
        });
    }
    timed(kPressure, [&] { compute_pressure(particles); });
}

PressureOptions Wcsph::pressure_options() const {
    PressureOptions options;
    options.artificial_viscosity = artificial_viscosity();
    options.controls_tension = p_.tension_control && is_adjoint() && p_.free_surface;
    options.tension_eigenvalue = 0.9;
    return options;
}

void Wcsph::compute_pressure(Particles& particles) {
    const PressureOptions options = pressure_options();
    const PairInput in = pair_input(particles, false);
    const bool separates = energies_.is_on() && options.artificial_viscosity != 0.0;
    if (separates) {
        PressureOptions without = options;
        without.artificial_viscosity = 0.0;
        sums_->pressure(in, data(particles), is_adjoint(), without);
        energies_.note_without_artificial(particles.a);
    }
    sums_->pressure(in, data(particles), is_adjoint(), options);
    if (separates) energies_.note_with_artificial(particles.a, dimensions_);
    if (energies_.is_on()) energies_.note_wall_pressure(wall_power(particles).pressure);
}

void Wcsph::acoustic_step(Particles& particles, const Surroundings& surroundings, double t, double dt) {
    const double reach = 1.5 * dt * std::max(max_speed_ + max_acceleration_ * dt, 1e-300);
    if (2.0 * (moved_ + reach) > kSkin * spacing_) timed(kNeighbours, [&] { sort_all(particles, surroundings); });
    moved_ += reach;
    if (energies_.is_on()) energies_.count_kick(particles, 0.5 * dt);
    timed(kAdvance, [&] { kick_drift(particles, 0.5 * dt, 0.5 * dt); });
    if (walls_.has_moving()) timed(kWalls, [&] { place_walls(surroundings, t + 0.5 * dt, false); });
    timed(kContinuity, [&] {
        ContinuityOptions options;
        options.diffusion = p_.density_diffusion_factor * h() * c0_;
        if (p_.density_diffusion == DensityDiffusion::fourtakas)
            for (int k = 0; k < 3; ++k) options.g_over_c2[k] = p_.gravity[k] / (c0_ * c0_);
        const PairInput in = pair_input(particles, false);
        if (energies_.is_on()) {
            sums_->continuity(in, data(particles), DensityDiffusion::none, options);
            energies_.note_without_diffusion(state_.delta_rate);
        }
        sums_->continuity(in, data(particles), p_.density_diffusion, options);
    });
    timed(kAdvance, [&] { compute_state(particles, dt, 0.5 * dt); });
    if (energies_.is_on()) energies_.count_diffusion(particles, state_, energy_setting(surroundings), dt);
    if (walls_.has_moving()) timed(kWalls, [&] { place_walls(surroundings, t + dt, false); });
    compute_pressure_forces(particles);
    if (energies_.is_on()) energies_.count_kick(particles, 0.5 * dt);
    timed(kAdvance, [&] { kick_drift(particles, 0.5 * dt, 0.0); });
}

StepReport Wcsph::step(Particles& particles, const Surroundings& surroundings) {
    if (std::exchange(has_new_parameters_, false)) use_new_parameters(particles, surroundings);
    if (objects_version_ != surroundings.objects_version) place_walls(surroundings, surroundings.time, true);
    const double dt = next_.dt, t = surroundings.time;
    if (2.0 * (moved_ + p_.shifting_limit * spacing_) > kSkin * spacing_)
        timed(kNeighbours, [&] { sort_all(particles, surroundings); });
    const bool shifts = p_.shifting && max_speed_ > 0.0;
    timed(kGeometry, [&] { compute_geometry(particles, shifts); });
    timed(kSlow, [&] { compute_slow_forces(particles, surroundings); });
    if (energies_.is_on() && !energies_.has_started()) start_energies(particles, surroundings);
    const double part = dt / next_.acoustic_steps;
    for (int k = 0; k < next_.acoustic_steps; ++k) {
        acoustic_step(particles, surroundings, t + k * part, part);
        if (!shifts) continue;
        timed(kAdvance, [&] {
            count_loss(particles, surroundings, [&] { apply_shift(particles, 1.0 / next_.acoustic_steps); });
        });
    }
    timed(kWalls, [&] {
        std::uint64_t count = 0;
        count_loss(particles, surroundings, [&] { count = walls_.hold(particles, grid_, dt); });
        put_back_ += count;
        if (count > 0) moved_ += kSkin * spacing_;  // further than the drift tells: sort before the next step
    });
    return finish(particles, surroundings, dt);
}

// The next step by the criteria, growing by 10 % at most: a sudden end of all forces is rarely the truth.
StepChoice Wcsph::limit_step(double dt_before) const {
    constexpr double kGrowth = 1.1;
    StepChoice choice = choose_step({h(), c0_, max_speed_, max_acceleration_, p_.viscosity / p_.rest_density,
                                     p_.surface_tension / p_.rest_density, p_.cfl, p_.advective_cfl,
                                     p_.dual_time_step ? static_cast<int>(p_.most_acoustic_steps) : 1});
    const double acoustic = choice.dt / choice.acoustic_steps;
    if (p_.time_step > 0.0) {
        choice = {p_.time_step, 1, "fixed"};
    } else if (dt_before > 0.0 && choice.dt > kGrowth * dt_before) {
        choice.dt = kGrowth * dt_before;
    } else {
        return choice;
    }
    choice.acoustic_steps = p_.dual_time_step ? std::max(1, static_cast<int>(std::ceil(choice.dt / acoustic))) : 1;
    return choice;
}

RunLimits Wcsph::run_limits() const {
    return {c0_,    p_.cfl * h() / c0_,    next_.dt,     next_.criterion,
            p_.cfl, WcsphParameters{}.cfl, p_.time_step, p_.sound_speed == 0.0};
}

// Speeds, the next step's length, what went wrong.
StepReport Wcsph::finish(Particles& particles, const Surroundings& surroundings, double dt) {
    StepReport report;
    timed(kCheck, [&] {
        Domain room = surroundings.domain;
        for (int k = 0; k < 3; ++k) {
            if (!room.periodic[k]) continue;  // where a particle may be outside until it is wrapped
            room.min[k] = -std::numeric_limits<double>::infinity();
            room.max[k] = std::numeric_limits<double>::infinity();
        }
        Inspection found = solver::inspect(particles, room);
        max_speed_ = found.max_speed;
        const Extremes extremes = find_extremes(particles, state_.delta);
        max_acceleration_ = extremes.max_acceleration;
        next_ = limit_step(dt > 0.0 ? next_.dt : 0.0);
        report = {dt, found.max_speed, std::move(found.fault)};
        if (report.fault)
            report.fault->remedy = remedy_for(report.fault->kind, run_limits());
        else
            report.fault = check_health(particles, extremes, run_limits());
    });
    return report;
}

// ---- parameters, plan -----------------------------------------------------------------------------------------------

// As set; the sound speed as it is, also where the rule has chosen it.
ParameterMap Wcsph::parameters() const {
    ParameterMap map = to_parameter_map(p_);
    if (c0_ > 0.0) map["sound_speed"] = c0_;
    return map;
}

std::optional<ParameterError> Wcsph::set_parameters(const ParameterMap& values) {
    if (auto error = check_parameters(table_, values)) return error;
    for (const auto& [key, value] : values) overrides_[key] = value;
    has_new_parameters_ = true;
    for (const char* name :
         {"gravity", "viscosity", "rest_density", "sound_speed", "reference_speed", "reference_length"})
        has_new_stiffness_ = has_new_stiffness_ || values.contains(name);
    energies_.follow(energies_.is_on());  // another fluid: the account begins anew
    p_ = make_wcsph_parameters(overrides_);
    return std::nullopt;
}

// Particles keep their volume when the rest density changes: the pressure of still fluid grows with it. They keep their
// pressure when the state equation changes: kept densities would put energy into the fluid with each stiffening.
void Wcsph::use_new_parameters(Particles& particles, const Surroundings& surroundings) {
    const double rest_density_before = eos_.rho0_c2 / (c0_ * c0_);
    const double factor = p_.rest_density / rest_density_before;
    if (std::abs(factor - 1.0) > 1e-12)
        for (double& m : particles.m) m *= factor;
    support_ = p_.support_over_spacing * spacing_;
    sums_ = make_wcsph_sums(dimensions_, p_.kernel, support_, best_isa());
    set_flat_surface();
    walls_ = WallField(dimensions_, spacing_, support_);
    place_walls(surroundings, surroundings.time, true);
    const double c0_before = c0_;
    // Only when what the rule depends on has changed: its speeds are those of now.
    if (std::exchange(has_new_stiffness_, false)) c0_ = choose_sound_speed(p_, particles, spacing_, walls_.max_speed());
    if (p_.sound_speed <= 0.0) c0_ = std::max(c0_, c0_before);  // the rule may stiffen a running fluid, never soften it
    const StateEquation eos_before = eos_;
    set_state_equation();
    for (double& delta : state_.delta) delta = eos_.deviation(factor * eos_before.pressure(delta));
    sort_all(particles, surroundings);
    compute_state(particles, 0.0, 0.0);
    next_ = limit_step(next_.dt);
}

std::optional<std::string> Wcsph::refuse_domain(const Domain& domain) const {
    for (int k = 0; k < dimensions_; ++k) {
        if (!domain.periodic[k] || fits_period(domain.max[k] - domain.min[k], cell_side())) continue;
        char text[160];
        std::snprintf(text, sizeof text,
                      "the domain is periodic along axis %d but shorter than three cells of %.4g m; enlarge it or "
                      "reduce the spacing",
                      k, cell_side());
        return text;
    }
    return std::nullopt;
}

std::string Wcsph::walls_reason() const {
    if (walls_.is_empty()) return "no objects";
    return "pressure and place of " + std::to_string(walls_.size()) + " wall particles; " + std::to_string(put_back_) +
           " fluid particles put back on a surface so far";
}

std::vector<Stage> Wcsph::plan(const Surroundings&) const {
    return {{"neighbours", true,
             "cells, reused while nothing has moved out of them; " + std::to_string(separated_) +
                 " coincident pairs moved apart so far",
             seconds_[kNeighbours]},
            {"geometry", true, "moment matrices, free surface, shift", seconds_[kGeometry]},
            {"slow_forces", true, "gravity, body force, viscosity, tension", seconds_[kSlow]},
            {"continuity", true, "density", seconds_[kContinuity]},
            {"walls", !walls_.is_empty(), walls_reason(), seconds_[kWalls]},
            {"pressure_force", true, "", seconds_[kPressure]},
            {"advance", true, "kick, drift, state equation", seconds_[kAdvance]},
            {"check", true, "", seconds_[kCheck]}};
}

// ---- what the model tells about itself ------------------------------------------------------------------------------

TermOptions Wcsph::term_options() const {
    return {is_adjoint(),
            is_morris(),
            pressure_options(),
            viscosity_options(),
            p_.tension_form == TensionForm::continuum,
            tension_options()};
}

// By name: objects that came after the last step feel nothing yet.
std::vector<ObjectLoad> Wcsph::object_loads(const Particles& particles, const Surroundings& surroundings) const {
    std::vector<ObjectLoad> loads(surroundings.objects.size());
    if (walls_.is_empty()) return loads;
    const std::vector<WallForce> forces =
        compute_wall_forces(pair_input(particles, true), view(particles), *sums_, term_options());
    const std::vector<ObjectLoad> known = sum_object_loads(walls_.particles(), forces, object_names_.size());
    for (std::size_t o = 0; o < loads.size(); ++o) {
        const auto found = std::find(object_names_.begin(), object_names_.end(), surroundings.objects[o].name);
        if (found != object_names_.end()) loads[o] = known[static_cast<std::size_t>(found - object_names_.begin())];
    }
    return loads;
}

// Walls at rest do no work: they are not asked.
WallPower Wcsph::wall_power(const Particles& particles) const {
    if (walls_.is_empty() || walls_.max_speed() == 0.0) return {};
    return compute_wall_power(
        walls_.particles(), compute_wall_forces(pair_input(particles, true), view(particles), *sums_, term_options()));
}

// The first kick still has the acceleration of the step before, which nobody has taken apart: its parts are taken to
// be those of the present state.
void Wcsph::start_energies(Particles& particles, const Surroundings& surroundings) {
    const VectorField a = particles.a;
    compute_pressure(particles);
    particles.a = a;
    energies_.start(stored_energy(particles, surroundings));
}

std::optional<EnergyBudget> Wcsph::energies(const Particles& particles, const Surroundings& surroundings) const {
    return energies_.budget(compute_stored_energy(particles, state_.delta, energy_setting(surroundings)));
}

std::optional<ParticleInspection> Wcsph::inspect(const Particles& particles, const Surroundings& surroundings,
                                                 Index id) const {
    const WcsphView seen = view(particles);
    const TermOptions options = term_options();
    return inspect_particle(
        {seen, *sums_, options, surroundings, object_names_, support_, p_.gravity, walls_.thin_walls()}, id);
}

}  // namespace

std::unique_ptr<Model> make_wcsph(int dimensions, double spacing, const ParameterMap& overrides) {
    return std::make_unique<Wcsph>(dimensions, spacing, overrides);
}

}  // namespace headrace::solver
