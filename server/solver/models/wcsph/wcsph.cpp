#include "server/solver/models/wcsph/wcsph.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "server/solver/boundaries/wall_particles.h"
#include "server/solver/eos.h"
#include "server/solver/faults.h"
#include "server/solver/models/wcsph/parameters.h"
#include "server/solver/models/wcsph/step_criteria.h"
#include "server/solver/models/wcsph/sums.h"
#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

enum StageIndex { kNeighbours, kGeometry, kSlow, kContinuity, kWalls, kPressure, kAdvance, kCheck, kStageCount };

double length_of(const Vec3& u) {
    return std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
}

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
          sums_(make_wcsph_sums(dimensions, p_.kernel, support_, best_isa())) {}

    std::string_view name() const override { return "wcsph"; }

    StepReport initialise(Particles& particles, const Surroundings& surroundings) override;
    StepReport step(Particles& particles, const Surroundings& surroundings) override;

    double time_step() const override { return next_.dt; }
    std::string_view time_step_limit() const override { return next_.criterion; }
    double particle_mass() const override { return p_.rest_density * std::pow(spacing_, dimensions_); }
    double rest_density() const override { return p_.rest_density; }
    double support_radius() const override { return support_; }
    Vec3 gravity() const override { return p_.gravity; }
    const std::vector<ParameterInfo>& parameter_table() const override { return table_; }
    ParameterMap parameters() const override { return to_parameter_map(p_); }
    std::optional<ParameterError> set_parameters(const ParameterMap& values) override;
    std::vector<Stage> plan(const Surroundings& surroundings) const override;
    std::string walls_reason() const;
    std::optional<std::string> refuse_object(const CollisionObject&) const override { return std::nullopt; }
    std::optional<std::string> refuse_domain(const Domain& domain) const override;

  private:
    static constexpr std::size_t kWallCellBlock = 64;
    static constexpr double kSkin = 0.5;  // [spacings] by which cells are wider than the support

    template <class Work>
    void timed(StageIndex stage, Work&& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        seconds_[stage] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    double h() const { return 0.5 * support_; }
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
    PassData data(Particles& particles) { return {particles, state_, walls_.particles(), wall_}; }

    void choose_sound_speed(const Particles& particles, const Surroundings& surroundings);
    void resize_state(std::size_t count);
    void sort_all(Particles& particles, const Surroundings& surroundings);
    void wrap(Particles& particles, const Domain& domain) const;
    void place_walls(const Surroundings& surroundings, double t, bool anew);
    void evaluate_wall_gravity(const Surroundings& surroundings, double t);
    PairInput pair_input(const Particles& particles, bool centres_are_walls) const;
    void compute_geometry(Particles& particles, bool shifts);
    void apply_shift(Particles& particles, double share);
    void compute_slow_forces(Particles& particles, const Surroundings& surroundings);
    void compute_state(Particles& particles, double dt, double drift);
    void compute_pressure_forces(Particles& particles);
    void kick_drift(Particles& particles, double kick, double drift);
    void acoustic_step(Particles& particles, const Surroundings& surroundings, double t, double dt);
    void hold_at_walls(Particles& particles, double dt);
    bool put_back(Vec3& x, Vec3& v, double dt) const;
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
    Walls walls_;
    std::uint64_t objects_version_{~std::uint64_t{0}};
    WallState wall_;
    WcsphState state_;
    Particles midpoint_;  // where the body force is evaluated; empty without one
    std::unique_ptr<WcsphSums> sums_;
    Vec3 period_{};  // [m]

    double max_speed_{}, max_acceleration_{};  // [m/s], [m/s^2] at the end of the last step
    std::uint64_t step_{};
    std::uint64_t put_back_{};  // particles put back on a wall's surface so far
    double moved_{};            // [m] at most, since the last sort
    StepChoice next_;
    std::array<double, kStageCount> seconds_{};
    std::vector<double> scratch_;
    std::vector<Index> scratch_id_;
};

// ---- start ----------------------------------------------------------------------------------------------------------

// Dong & others' rule in words: density varies by 1 % where the Mach number is 0.1, the body force over L or the
// viscous stress over L is balanced by 1 % of rho0 c0^2.
void Wcsph::choose_sound_speed(const Particles& particles, const Surroundings& surroundings) {
    constexpr double kCompression = 0.01;
    if (p_.sound_speed > 0.0) {
        c0_ = p_.sound_speed;
    } else {
        double speed = 0.0;
        Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
        for (std::size_t i = 0; i < particles.size(); ++i) {
            double v2 = 0.0;
            for (int k = 0; k < dimensions_; ++k) {
                v2 += particles.v[k][i] * particles.v[k][i];
                low[k] = std::min(low[k], particles.x[k][i]);
                high[k] = std::max(high[k], particles.x[k][i]);
            }
            speed = std::max(speed, v2);
        }
        speed = std::sqrt(speed);
        for (std::size_t w = 0; w < walls_.particles().size(); ++w) {
            double v2 = 0.0;
            for (int k = 0; k < dimensions_; ++k) v2 += walls_.particles().v[k][w] * walls_.particles().v[k][w];
            speed = std::max(speed, std::sqrt(v2));
        }
        const double g = length_of(p_.gravity);
        double extent = 0.0, height = 0.0;
        for (int k = 0; k < dimensions_; ++k) {
            const double along = particles.size() > 0 ? high[k] - low[k] + spacing_ : 0.0;
            extent = std::max(extent, along);
            if (g > 0.0) height += along * std::abs(p_.gravity[k]) / g;
        }
        double body = g;
        if (surroundings.body_force != nullptr) {
            double a2 = 0.0;
            for (std::size_t i = 0; i < particles.size(); ++i) {
                double sum = 0.0;
                for (int k = 0; k < dimensions_; ++k) sum += particles.a[k][i] * particles.a[k][i];
                a2 = std::max(a2, sum);
            }
            body += std::sqrt(a2);
        }
        const double L = p_.reference_length > 0.0 ? p_.reference_length : (g > 0.0 ? height : extent);
        const double V = p_.reference_speed > 0.0 ? p_.reference_speed : std::max(speed, std::sqrt(2.0 * g * height));
        c0_ = std::max({10.0 * V, std::sqrt(body * L / kCompression),
                        std::sqrt(p_.viscosity / p_.rest_density * V / (L * kCompression))});
        if (!(c0_ > 0.0)) c0_ = 1.0;  // nothing moves it: any speed will do
    }
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

StepReport Wcsph::initialise(Particles& particles, const Surroundings& surroundings) {
    for (int k = 0; k < 3; ++k) {
        particles.v_half[k].clear();
        period_[k] = surroundings.domain.max[k] - surroundings.domain.min[k];
        std::fill(particles.a[k].begin(), particles.a[k].end(), 0.0);
    }
    if (surroundings.body_force != nullptr) (*surroundings.body_force)(surroundings.time, particles, particles.a);
    place_walls(surroundings, surroundings.time, true);
    choose_sound_speed(particles, surroundings);
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
    grid_.build(particles.x, particles.id, dimensions_, support_ + kSkin * spacing_, &surroundings.domain);
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
    moved_ = 0.0;
}

// Puts the walls where they are at time t and sorts them.
void Wcsph::place_walls(const Surroundings& surroundings, double t, bool anew) {
    if (anew) {
        walls_.rebuild(surroundings.objects, surroundings.domain, t);
        objects_version_ = surroundings.objects_version;
    } else if (!walls_.move_to(t)) {
        return;
    }
    WallParticles& w = walls_.particles();
    wall_.no_slip.resize(w.size());
    wall_.p.resize(w.size());
    wall_.delta.resize(w.size());
    if (w.size() == 0) return;
    wall_.grid.build(w.x, w.id, dimensions_, support_ + kSkin * spacing_, &surroundings.domain);
    for (std::vector<Index>* field : {&w.id, &w.object, &w.sheet}) wall_.grid.permute(*field, scratch_id_);
    for (VectorField* field : {&w.x, &w.v, &w.a, &w.n})
        for (int k = 0; k < dimensions_; ++k) wall_.grid.permute((*field)[k], scratch_);
    wall_.grid.permute(w.V, scratch_);
    wall_.grid.permute(w.depth, scratch_);
    for (std::size_t k = 0; k < w.size(); ++k) {
        const Slip slip = surroundings.objects[w.object[k]].slip;
        wall_.no_slip[k] = (slip == Slip::by_model ? p_.wall_slip : slip) == Slip::no_slip ? 1.0 : 0.0;
    }
    evaluate_wall_gravity(surroundings, t);
}

// What a fluid particle at the wall would feel, seen from the wall.
void Wcsph::evaluate_wall_gravity(const Surroundings& surroundings, double t) {
    const WallParticles& w = walls_.particles();
    for (int k = 0; k < dimensions_; ++k) wall_.g[k].assign(w.size(), p_.gravity[k]);
    if (surroundings.body_force != nullptr) {
        Particles there;
        there.dimensions = dimensions_;
        there.resize(w.size());
        there.x = w.x;
        there.v = w.v;
        (*surroundings.body_force)(t, there, wall_.g);
    }
    for (int k = 0; k < dimensions_; ++k)
        for (std::size_t i = 0; i < w.size(); ++i) wall_.g[k][i] -= w.a[k][i];
}

PairInput Wcsph::pair_input(const Particles& particles, bool centres_are_walls) const {
    PairInput in;
    in.fluid = {&grid_, &particles.x, state_.V.data()};
    if (walls_.particles().size() > 0) in.walls = {&wall_.grid, &walls_.particles().x, walls_.particles().V.data()};
    in.centres = centres_are_walls ? in.walls : in.fluid;
    in.centres_are_walls = centres_are_walls;
    in.period = period_;
    in.support = support_;
    in.thin_walls = walls_.has_thin() ? &walls_ : nullptr;
    return in;
}

// ---- once per step --------------------------------------------------------------------------------------------------

void Wcsph::compute_geometry(Particles& particles, bool shifts) {
    GeometryOptions options;
    options.correction_threshold = p_.pressure_gradient == PressureGradient::plain
                                       ? std::numeric_limits<double>::infinity()
                                   : is_adjoint() ? p_.correction_threshold
                                                  : 0.3;
    options.shifting = shifts;
    options.reconstructs =
        p_.artificial_viscosity > 0.0 && p_.artificial_viscosity_form == ArtificialViscosity::reconstructed;
    options.shift_factor = p_.shifting_factor * max_speed_ * next_.dt * 2.0 * h();
    options.W_dx = sums_->W(spacing_);
    options.dynamic_pressure = p_.rest_density * max_speed_ * max_speed_;
    options.noise = kShiftNoise * max_speed_ * next_.dt;
    options.step = ++step_;
    options.limits.longest = p_.shifting_limit * spacing_;
    if (!p_.free_surface) options.limits.surface_eigenvalue = options.limits.spray_eigenvalue = -1.0;
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
    if (p_.viscosity > 0.0) {
        sums_->viscosity(pair_input(particles, false), data(particles), is_morris(), {p_.viscosity, 0.25 * spacing_});
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
    if (walls_.particles().size() > 0) {
        timed(kWalls, [&] {
            sums_->wall_pressure(pair_input(particles, true), data(particles),
                                 {least_wall_pressure(), p_.rest_density * c0_ * c0_});
        });
    }
    timed(kPressure, [&] {
        PressureOptions options;
        options.artificial_viscosity = p_.artificial_viscosity * h() * c0_ * p_.rest_density;
        options.controls_tension = p_.tension_control && is_adjoint() && p_.free_surface;
        options.tension_eigenvalue = 0.9;
        sums_->pressure(pair_input(particles, false), data(particles), is_adjoint(), options);
    });
}

void Wcsph::acoustic_step(Particles& particles, const Surroundings& surroundings, double t, double dt) {
    const double reach = 1.5 * dt * std::max(max_speed_ + max_acceleration_ * dt, 1e-300);
    if (2.0 * (moved_ + reach) > kSkin * spacing_) timed(kNeighbours, [&] { sort_all(particles, surroundings); });
    moved_ += reach;
    timed(kAdvance, [&] { kick_drift(particles, 0.5 * dt, 0.5 * dt); });
    if (walls_.has_moving()) timed(kWalls, [&] { place_walls(surroundings, t + 0.5 * dt, false); });
    timed(kContinuity, [&] {
        ContinuityOptions options;
        options.diffusion = p_.density_diffusion_factor * h() * c0_;
        if (p_.density_diffusion == DensityDiffusion::fourtakas)
            for (int k = 0; k < 3; ++k) options.g_over_c2[k] = p_.gravity[k] / (c0_ * c0_);
        sums_->continuity(pair_input(particles, false), data(particles), p_.density_diffusion, options);
    });
    timed(kAdvance, [&] { compute_state(particles, dt, 0.5 * dt); });
    if (walls_.has_moving()) timed(kWalls, [&] { place_walls(surroundings, t + dt, false); });
    compute_pressure_forces(particles);
    timed(kAdvance, [&] { kick_drift(particles, 0.5 * dt, 0.0); });
}

StepReport Wcsph::step(Particles& particles, const Surroundings& surroundings) {
    if (objects_version_ != surroundings.objects_version) place_walls(surroundings, surroundings.time, true);
    const double dt = next_.dt, t = surroundings.time;
    if (2.0 * (moved_ + p_.shifting_limit * spacing_) > kSkin * spacing_)
        timed(kNeighbours, [&] { sort_all(particles, surroundings); });
    const bool shifts = p_.shifting && max_speed_ > 0.0;
    timed(kGeometry, [&] { compute_geometry(particles, shifts); });
    timed(kSlow, [&] { compute_slow_forces(particles, surroundings); });
    const double part = dt / next_.acoustic_steps;
    for (int k = 0; k < next_.acoustic_steps; ++k) {
        acoustic_step(particles, surroundings, t + k * part, part);
        if (shifts) timed(kAdvance, [&] { apply_shift(particles, 1.0 / next_.acoustic_steps); });
    }
    timed(kWalls, [&] { hold_at_walls(particles, dt); });
    return finish(particles, surroundings, dt);
}

// A particle that was driven into a solid (an impact faster than the walls' pressure can answer) is put back on its
// surface and loses its velocity into it: nothing leaks. Rare in a sound run; counted in the plan.
bool Wcsph::put_back(Vec3& x, Vec3& v, double dt) const {
    constexpr int kMostSurfaces = 4;  // a corner of three, and one more
    bool is_moved = false;
    const auto stop = [&](std::size_t object, const Vec3& n) {
        const Vec3 wall = walls_.velocity(object, x);
        double into = 0.0;
        for (int k = 0; k < dimensions_; ++k) into += (v[k] - wall[k]) * n[k];
        for (int k = 0; k < dimensions_; ++k) v[k] -= std::min(into, 0.0) * n[k];
    };
    if (walls_.has_thin()) {
        Vec3 before = x;
        for (int k = 0; k < dimensions_; ++k) before[k] -= dt * v[k];
        if (walls_.is_blocked(before, x)) {
            std::size_t object = 0;
            Vec3 n{};
            walls_.distance_to_any(before, &object, &n);
            x = before;
            stop(object, n);
            is_moved = true;
        }
    }
    for (int turn = 0; turn < kMostSurfaces; ++turn) {
        std::size_t object = 0;
        Vec3 n{};
        const double distance = walls_.distance_to_any(x, &object, &n);
        if (distance >= 0.0) break;
        for (int k = 0; k < dimensions_; ++k) x[k] -= distance * n[k];
        stop(object, n);
        is_moved = true;
    }
    return is_moved;
}

void Wcsph::hold_at_walls(Particles& particles, double dt) {
    if (walls_.particles().size() == 0) return;
    std::vector<std::uint64_t> counts((grid_.cells() + kWallCellBlock - 1) / kWallCellBlock);
    parallel_for(grid_.cells(), kWallCellBlock, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t c = first; c < last; ++c) {
            if (wall_.grid.around(grid_.coordinates(c)).particles == 0) continue;
            const Run cell = grid_.cell(c);
            for (Index i = cell.begin; i < cell.end; ++i) {
                Vec3 x{}, v{};
                for (int k = 0; k < dimensions_; ++k) {
                    x[k] = particles.x[k][i];
                    v[k] = particles.v[k][i];
                }
                if (!put_back(x, v, dt)) continue;
                ++counts[first / kWallCellBlock];
                for (int k = 0; k < dimensions_; ++k) {
                    particles.x[k][i] = x[k];
                    particles.v[k][i] = v[k];
                }
            }
        }
    });
    std::uint64_t count = 0;
    for (const std::uint64_t part : counts) count += part;
    put_back_ += count;
    if (count > 0) moved_ += kSkin * spacing_;  // further than the drift tells: sort before the next step
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
        max_acceleration_ = std::sqrt(parallel_reduce(
            particles.size(), 0.0,
            [&](std::size_t begin, std::size_t end) {
                double largest = 0.0;
                for (std::size_t i = begin; i < end; ++i) {
                    double a2 = 0.0;
                    for (int k = 0; k < dimensions_; ++k) a2 += particles.a[k][i] * particles.a[k][i];
                    largest = std::max(largest, a2);
                }
                return largest;
            },
            [](double a, double b) { return std::max(a, b); }));
        const double before = next_.dt;
        next_ = choose_step({h(), c0_, max_speed_, max_acceleration_, p_.viscosity / p_.rest_density,
                             p_.surface_tension / p_.rest_density, p_.cfl, p_.advective_cfl,
                             p_.dual_time_step ? static_cast<int>(p_.most_acoustic_steps) : 1});
        // A step grows slowly: a sudden end of all forces is rarely the truth.
        if (dt > 0.0 && before > 0.0 && next_.dt > 1.1 * before) {
            const double part = next_.dt / next_.acoustic_steps;
            next_.dt = 1.1 * before;
            next_.acoustic_steps = std::max(1, static_cast<int>(std::ceil(next_.dt / part)));
        }
        if (p_.time_step > 0.0) {
            const double part = p_.cfl * h() / (c0_ + max_speed_);
            next_ = {p_.time_step, 1, "fixed"};
            if (p_.dual_time_step) next_.acoustic_steps = std::max(1, static_cast<int>(std::ceil(next_.dt / part)));
        }
        report = {dt, found.max_speed, std::move(found.fault)};
        if (report.fault) report.fault->remedy = "check the scene, or reduce cfl";
    });
    return report;
}

// ---- parameters, plan -----------------------------------------------------------------------------------------------

std::optional<ParameterError> Wcsph::set_parameters(const ParameterMap& values) {
    if (auto error = check_parameters(table_, values)) return error;
    for (const auto& [key, value] : values) overrides_[key] = value;
    p_ = make_wcsph_parameters(overrides_);
    return std::nullopt;
}

std::optional<std::string> Wcsph::refuse_domain(const Domain& domain) const {
    for (int k = 0; k < dimensions_; ++k) {
        if (!domain.periodic[k] || fits_period(domain.max[k] - domain.min[k], support_ + kSkin * spacing_)) continue;
        char text[160];
        std::snprintf(text, sizeof text,
                      "the domain is periodic along axis %d but shorter than three cells of %.4g m; enlarge it or "
                      "reduce the spacing",
                      k, support_ + kSkin * spacing_);
        return text;
    }
    return std::nullopt;
}

std::string Wcsph::walls_reason() const {
    if (walls_.particles().size() == 0) return "no objects";
    return "pressure and place of " + std::to_string(walls_.particles().size()) + " wall particles; " +
           std::to_string(put_back_) + " fluid particles put back on a surface so far";
}

std::vector<Stage> Wcsph::plan(const Surroundings&) const {
    return {{"neighbours", true, "cells, reused while nothing has moved out of them", seconds_[kNeighbours]},
            {"geometry", true, "moment matrices, free surface, shift", seconds_[kGeometry]},
            {"slow_forces", true, "gravity, body force, viscosity, tension", seconds_[kSlow]},
            {"continuity", true, "density", seconds_[kContinuity]},
            {"walls", walls_.particles().size() > 0, walls_reason(), seconds_[kWalls]},
            {"pressure_force", true, "", seconds_[kPressure]},
            {"advance", true, "kick, drift, state equation", seconds_[kAdvance]},
            {"check", true, "", seconds_[kCheck]}};
}

}  // namespace

std::unique_ptr<Model> make_wcsph(int dimensions, double spacing, const ParameterMap& overrides) {
    return std::make_unique<Wcsph>(dimensions, spacing, overrides);
}

}  // namespace headrace::solver
