#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "server/solver/faults.h"
#include "server/solver/models/wcsph/coincident.h"
#include "server/solver/models/wcsph/sound_speed.h"
#include "server/solver/models/wcsph/wcsph_model.h"
#include "server/solver/pairs/instruction_sets.h"
#include "server/solver/parallel.h"

namespace headrace::solver {

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

void Wcsph::put_in_order(Particles& particles, const Surroundings& surroundings) {
    wrap(particles, surroundings.domain);
    order_.build(particles.x, particles.id, dimensions_, spacing_, surroundings.domain);
    std::vector<Index> id_scratch;
    std::vector<double> scratch;
    std::vector<float> narrow_scratch;
    order_.permute(particles.id, id_scratch);
    for (VectorField* field : {&particles.x, &particles.v, &particles.a, &state_.a_slow}) {
        for (std::vector<double>& component : *field)
            if (!component.empty()) order_.permute(component, scratch);
    }
    for (std::vector<double>* field : {&particles.m, &particles.rho, &particles.p, &state_.delta, &state_.delta_rate})
        order_.permute(*field, scratch);
    for (NarrowField* field : {&state_.grad_delta, &state_.dx, &state_.dv})
        for (int k = 0; k < dimensions_; ++k) order_.permute((*field)[k], narrow_scratch);
    for (std::vector<float>* field : {&state_.min_eigenvalue, &state_.unevenness, &state_.ddelta})
        order_.permute(*field, narrow_scratch);
    for (MatrixField* field : {&state_.B, &state_.strain})
        for (int k = 0; k < symmetric_size(dimensions_); ++k) order_.permute((*field)[k], narrow_scratch);
    if (!wall_gravity_[0].empty())
        for (int k = 0; k < dimensions_; ++k) order_.permute(wall_gravity_[k], scratch);
    if (energies_.is_on()) energies_.permute(order_, scratch);
    order_.forget_moves();
    ++sorts_;
}

void Wcsph::sort_all(Particles& particles, const Surroundings& surroundings) {
    constexpr int kMostTurns = 4;  // crowds in one place thin out over the sorts to come
    sums_->release();              // its room is the sort's
    put_in_order(particles, surroundings);
    for (int turn = 0; turn < kMostTurns; ++turn) {
        const std::uint64_t coincident = separate_coincident(particles, spacing_, step_);
        if (coincident == 0) break;
        separated_ += coincident;
        put_in_order(particles, surroundings);  // they have left their bins
    }
    list_neighbours(particles, surroundings);
}

void Wcsph::list_neighbours(const Particles& particles, const Surroundings& surroundings) {
    const bool is_first = std::exchange(is_first_list_, false);
    NeighbourInput in;
    in.dimensions = dimensions_;
    in.fluid = {&order_, &particles.x, volumes(particles), particles.size()};
    const bool has_new_walls = walls_.put_in_order(surroundings.domain) || is_first;
    in.walls = walls_.points();
    in.reach = {support_, skin() * spacing_, inner_skin() * spacing_, period_, nullptr};
    in.wall_skin = wall_skin() * spacing_;
    if (const Visibility* panels = walls_.thin_walls()) {
        using enum SightLines::Between;
        const VectorField &x = particles.x, &w = walls_.particles().x;
        among_fluid_ = {fluid_and_fluid, *panels, x, x, dimensions_, support_};
        fluid_to_wall_ = {fluid_and_wall, *panels, x, w, dimensions_, support_};
        wall_to_fluid_ = {wall_and_fluid, *panels, w, x, dimensions_, support_};
        in.among_fluid = &among_fluid_;
        in.fluid_to_wall = &fluid_to_wall_;
        in.wall_to_fluid = &wall_to_fluid_;
    }
    in.walls_move = walls_.has_moving();
    in.has_new_walls = has_new_walls;
    neighbours_->find(in);
    has_lists_ = true;
}

void Wcsph::find_neighbours(Particles& particles, const Surroundings& surroundings) {
    timed(kNeighbours, [&] {
        if (!has_lists_ || !neighbours_->move_fluid(particles.x, volumes(particles))) sort_all(particles, surroundings);
    });
}

void Wcsph::place_walls(const Surroundings& surroundings, double t, bool anew) {
    const WallOptions options = wall_options();
    if ((options.integrals || (options.by_default && dimensions_ == 3)) && !walls_.has_kernel())
        walls_.set_kernel(section_kernel());
    const WallField::Change change = walls_.place(surroundings, t, anew, options);
    using enum WallField::Change;
    if (change == others) has_lists_ = false;
    if (change == moved && has_lists_) has_lists_ = neighbours_->move_walls(walls_.particles().x, walls_.particles().V);
    if (!anew) return;
    objects_version_ = surroundings.objects_version;
    object_names_.clear();
    for (const CollisionObject& object : surroundings.objects) object_names_.push_back(object.name);
}

void Wcsph::make_sums() {
    const bool is_extreme = !(spacing_ >= 1e-6 && spacing_ <= 1e6);  // powers of it would leave single precision
    const bool is_double =
        p_.precision == Precision::double_precision || (p_.precision == Precision::automatic && is_extreme);
    neighbours_ = make_pair_neighbours(is_double ? Arithmetic::double_precision : Arithmetic::single_precision);
    has_lists_ = false;
    is_first_list_ = true;
    sums_ = make_wcsph_sums({dimensions_, p_.kernel, support_}, *neighbours_);
    isa_ = instruction_set();
    set_flat_surface();
}

SectionKernel Wcsph::section_kernel() const {
    const WcsphSums* sums = sums_.get();
    const double W_dx = sums->W(spacing_);
    const auto F_shifted = [=](double r) {
        return shifting_factor<2, double>({{}, r * r, r, 1.0}, sums->F(r), sums->W(r) / W_dx);
    };
    return {dimensions_, support_, [=](double r) { return sums->W(r); }, [=](double r) { return sums->F(r); },
            F_shifted};
}

// ---- once per step --------------------------------------------------------------------------------------------------

GeometryOptions Wcsph::geometry_options(bool shifts) const {
    GeometryOptions options;
    options.spacing = spacing_;
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
    options.rho0_c2 = eos_.rho0_c2;
    options.dynamic_pressure = p_.rest_density * max_speed_ * max_speed_;
    options.noise = kShiftNoise * next_.dt;
    options.limits.longest = p_.shifting_limit * spacing_;
    if (p_.surface_tension > options.dynamic_pressure * spacing_) options.limits.spray_eigenvalue = kSurfaceInSight;
    if (!p_.free_surface) options.limits.surface_eigenvalue = options.limits.spray_eigenvalue = -1.0;
    return options;
}

void Wcsph::compute_geometry(Particles& particles, bool shifts) {
    GeometryOptions options = geometry_options(shifts);
    options.step = ++step_;
    sums_->geometry(data(particles), options);
}

// A share of the step's shift, and what it carries along.
void Wcsph::apply_shift(Particles& particles, double share) {
    parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (int k = 0; k < dimensions_; ++k) {
            for (std::size_t i = begin; i < end; ++i) {
                particles.x[k][i] += share * static_cast<double>(state_.dx[k][i]);
                particles.v[k][i] += share * static_cast<double>(state_.dv[k][i]);
            }
        }
        for (std::size_t i = begin; i < end; ++i) state_.delta[i] += share * static_cast<double>(state_.ddelta[i]);
    });
}

void Wcsph::compute_slow_forces(Particles& particles, const Surroundings& surroundings) {
    const bool is_gravity_all =
        surroundings.body_force == nullptr && p_.viscosity == 0.0 && p_.surface_tension == 0.0 && !energies_.is_on();
    timed(kGravity, [&] {
        for (int k = 0; k < dimensions_; ++k) {
            if (is_gravity_all)
                std::vector<double>().swap(state_.a_slow[k]);
            else
                state_.a_slow[k].assign(particles.size(), p_.gravity[k]);
        }
    });
    if (surroundings.body_force != nullptr) timed(kBodyForce, [&] { add_body_force(particles, surroundings); });
    if (energies_.is_on()) energies_.note_body_force(state_.a_slow, energy_setting(surroundings), dimensions_);
    if (p_.viscosity > 0.0) {
        timed(kViscosity, [&] { sums_->viscosity(data(particles), is_morris(), viscosity_options()); });
        if (energies_.is_on()) {
            energies_.note_viscosity(state_.a_slow, dimensions_);
            energies_.note_wall_viscosity(wall_power(particles, surroundings).viscosity);
        }
    }
    if (p_.surface_tension > 0.0) {
        timed(kTension, [&] { compute_tension(particles, surroundings); });
        if (energies_.is_on()) energies_.note_tension(state_.a_slow, dimensions_);
    }
}

// At the middle of the step: held at its start, a spring would gain energy.
void Wcsph::add_body_force(const Particles& particles, const Surroundings& surroundings) {
    const double half = 0.5 * next_.dt;
    midpoint_.dimensions = dimensions_;
    midpoint_.id.resize(particles.size());
    for (int k = 0; k < dimensions_; ++k) {
        midpoint_.x[k].resize(particles.size());
        midpoint_.v[k].resize(particles.size());
        parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                midpoint_.v[k][i] = particles.v[k][i];
                midpoint_.x[k][i] = particles.x[k][i] + half * particles.v[k][i];
            }
        });
    }
    (*surroundings.body_force)(surroundings.time + half, midpoint_, state_.a_slow);
    if (!walls_.integrals().is_empty()) wall_gravity_ = state_.a_slow;
}

// On the positions that the step's force stands for: held at its start, the short capillary waves would gain energy.
void Wcsph::compute_tension(Particles& particles, const Surroundings& surroundings) {
    look_ahead(particles);
    if (!neighbours_->move_fluid(tension_x_, volumes(particles))) {
        sort_all(particles, surroundings);
        look_ahead(particles);
        neighbours_->move_fluid(tension_x_, volumes(particles));
    }
    for (int k = 0; k < symmetric_size(dimensions_); ++k) state_.surface_stress[k].resize(particles.size());
    if (p_.tension_form == TensionForm::continuum) {
        sums_->continuum_tension(data(particles), tension_options());
    } else {
        sums_->thesis_tension(data(particles), tension_options());
    }
}

void Wcsph::look_ahead(const Particles& particles) {
    const double ahead = 0.5 * next_.dt * (1.0 + 1.0 / next_.acoustic_steps);
    for (int k = 0; k < dimensions_; ++k) {
        tension_x_[k].resize(particles.size());
        parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) tension_x_[k][i] = particles.x[k][i] + ahead * particles.v[k][i];
        });
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
    parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (int k = 0; k < dimensions_; ++k) {
            for (std::size_t i = begin; i < end; ++i) particles.x[k][i] += drift * particles.v[k][i];
        }
        for (std::size_t i = begin; i < end; ++i) {
            const double delta = state_.delta[i] += dt * state_.delta_rate[i];
            particles.rho[i] = p_.rest_density * (1.0 + delta);
            particles.p[i] = eos_.pressure(delta);
        }
    });
}

void Wcsph::compute_pressure_forces(Particles& particles, const Surroundings& surroundings) {
    find_neighbours(particles, surroundings);
    if (!walls_.is_empty()) {
        timed(kWalls, [&] { sums_->wall_pressure(data(particles), {least_wall_pressure(), p_.gravity}); });
    }
    timed(kPressure, [&] { compute_pressure(particles, surroundings); });
}

PressureOptions Wcsph::pressure_options() const {
    PressureOptions options;
    options.artificial_viscosity = artificial_viscosity();
    options.controls_tension = p_.tension_control && is_adjoint() && p_.free_surface;
    options.walls_suck = least_wall_pressure() < 0.0;
    options.gravity = p_.gravity;
    return options;
}

// The artificial viscosity of how many acoustic steps acts with the k-th of a step: it is summed once for several, an
// impulse for all of them (as Tuckerman 1992 sums slow forces). It only damps, and an impulse does so as long as it
// takes less than the velocity there is. As a viscosity of alpha h c0/(2 (D + 2)) it takes 1.7 alpha (3D: 1.3) of a
// wave of two spacings in an acoustic step at the default cfl: two thirds of it at most in an impulse.
int Wcsph::artificial_weight(int k) const {
    if (artificial_viscosity() == 0.0) return 0;
    constexpr double kMostAlpha = 0.4;
    const int at_once = static_cast<int>(std::clamp(kMostAlpha / p_.artificial_viscosity, 1.0, 1000.0));
    return k % at_once == 0 ? std::min(at_once, next_.acoustic_steps - k) : 0;
}

void Wcsph::compute_pressure(Particles& particles, const Surroundings& surroundings) {
    PressureOptions options = pressure_options();
    options.artificial_viscosity *= artificial_weight_;
    const bool separates = energies_.is_on() && options.artificial_viscosity != 0.0;
    if (energies_.is_on() && !separates) energies_.note_no_artificial();
    if (separates) {
        PressureOptions without = options;
        without.artificial_viscosity = 0.0;
        sums_->pressure(data(particles), is_adjoint(), without);
        energies_.note_without_artificial(particles.a);
    }
    sums_->pressure(data(particles), is_adjoint(), options);
    if (separates) energies_.note_with_artificial(particles.a, dimensions_);
    if (energies_.is_on()) energies_.note_wall_pressure(wall_power(particles, surroundings).pressure);
}

void Wcsph::acoustic_step(Particles& particles, const Surroundings& surroundings, double t, double dt) {
    if (energies_.is_on()) energies_.count_kick(particles, 0.5 * dt);
    timed(kAdvance, [&] { kick_drift(particles, 0.5 * dt, 0.5 * dt); });
    if (walls_.has_moving()) timed(kWallMotion, [&] { place_walls(surroundings, t + 0.5 * dt, false); });
    find_neighbours(particles, surroundings);
    timed(kContinuity, [&] {
        ContinuityOptions options;
        options.diffusion = p_.density_diffusion_factor * h() * c0_;
        if (diffusion() == DensityDiffusion::fourtakas)
            for (int k = 0; k < 3; ++k) options.g_over_c2[k] = p_.gravity[k] / (c0_ * c0_);
        if (energies_.is_on()) {
            sums_->continuity(data(particles), DensityDiffusion::none, options);
            energies_.note_without_diffusion(state_.delta_rate);
        }
        sums_->continuity(data(particles), diffusion(), options);
    });
    timed(kAdvance, [&] { compute_state(particles, dt, 0.5 * dt); });
    if (energies_.is_on()) energies_.count_diffusion(particles, state_, energy_setting(surroundings), dt);
    if (walls_.has_moving()) timed(kWallMotion, [&] { place_walls(surroundings, t + dt, false); });
    compute_pressure_forces(particles, surroundings);
    if (energies_.is_on()) energies_.count_kick(particles, 0.5 * dt);
    timed(kAdvance, [&] { kick_drift(particles, 0.5 * dt, 0.0); });
}

StepReport Wcsph::step(Particles& particles, const Surroundings& surroundings) {
    if (std::exchange(has_new_parameters_, false)) use_new_parameters(particles, surroundings);
    if (objects_version_ != surroundings.objects_version) place_walls(surroundings, surroundings.time, true);
    const double dt = next_.dt, t = surroundings.time;
    find_neighbours(particles, surroundings);
    if (walls_.thin_walls() != nullptr) timed(kNeighbours, [&] { neighbours_->refresh_visibility(); });
    const bool shifts = has_shifting() && max_speed_ > 0.0;
    timed(kGeometry, [&] { compute_geometry(particles, shifts); });
    compute_slow_forces(particles, surroundings);
    if (energies_.is_on() && !energies_.has_started()) start_energies(particles, surroundings);
    const double part = dt / next_.acoustic_steps;
    for (int k = 0; k < next_.acoustic_steps; ++k) {
        artificial_weight_ = artificial_weight(k);
        acoustic_step(particles, surroundings, t + k * part, part);
        if (!shifts) continue;
        timed(kShifting, [&] {
            count_loss(particles, surroundings, [&] { apply_shift(particles, 1.0 / next_.acoustic_steps); });
        });
    }
    if (!walls_.is_empty())
        timed(kWalls, [&] {
            std::uint64_t count = 0;
            count_loss(particles, surroundings, [&] { count = walls_.hold(particles, *neighbours_, dt); });
            put_back_ += count;
        });
    return finish(particles, surroundings, dt);
}

// The next step by the criteria, growing by 10 % at most: a sudden end of all forces is rarely the truth.
StepChoice Wcsph::limit_step(double dt_before) const {
    constexpr double kGrowth = 1.1;
    // Monaghan and Gingold's form resists compression with three times its viscosity: still water with it was unstable
    // at Morris's limit and sound at 0.7 of it.
    const double stiffness = is_morris() ? 1.0 : 2.0;
    StepChoice choice =
        choose_step({h(), c0_, max_speed_, max_acceleration_, stiffness * p_.viscosity / p_.rest_density,
                     p_.surface_tension / p_.rest_density, p_.cfl, p_.advective_cfl, p_.shifting && !p_.free_surface,
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
    return {c0_,          p_.cfl * h() / c0_,    next_.dt,      next_.criterion, p_.cfl, WcsphParameters{}.cfl,
            p_.time_step, p_.sound_speed == 0.0, !is_adjoint(), p_.shifting};
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
        report = {dt, found.max_speed, next_.acoustic_steps, std::move(found.fault)};
        next_ = limit_step(dt > 0.0 ? next_.dt : 0.0);
        if (report.fault)
            report.fault->remedy = remedy_for(report.fault->kind, run_limits());
        else
            report.fault = check_health(particles, extremes, run_limits());
    });
    return report;
}

}  // namespace headrace::solver
