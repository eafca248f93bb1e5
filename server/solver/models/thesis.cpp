#include "server/solver/models/thesis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "server/solver/boundaries/collider.h"
#include "server/solver/eos.h"
#include "server/solver/faults.h"
#include "server/solver/integrator/leapfrog.h"
#include "server/solver/integrator/step_limits.h"
#include "server/solver/models/thesis_parameters.h"
#include "server/solver/models/thesis_sums.h"
#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

// Occupied cells a thread takes at a time: some hundred particles, enough work to hide the hand-out.
constexpr std::size_t kCellBlock = 16;

enum StageIndex { kSort, kDensity, kPressure, kForces, kAdvance, kCheck, kStageCount };

class Thesis final : public Model {
  public:
    Thesis(int dimensions, double spacing, const ParameterMap& overrides)
        : dimensions_(dimensions),
          spacing_(spacing),
          table_(thesis_parameter_table(dimensions, spacing)),
          overrides_(overrides),
          isa_(best_isa()),
          density_sum_(choose_density_sum(dimensions, isa_)) {
        use_overrides();
        dt_before_ = parameters_.time_step;
    }

    std::string_view name() const override { return "thesis"; }

    StepReport initialise(Particles& particles, const Surroundings& surroundings) override {
        step_ = 0;
        dt_before_ = parameters_.time_step;
        std::fill(particles.m.begin(), particles.m.end(), parameters_.particle_mass);
        sort(particles);
        compute_density(particles);
        compute_pressure(particles);
        compute_acceleration(particles);
        start_leap(particles);
        return check(particles, surroundings);
    }

    // Staubach 2010, section 3.3. Velocity enters the viscosity as formed in the step before (2.36 of then), density
    // and pressure left behind are those at the positions before the move.
    StepReport step(Particles& particles, const Surroundings& surroundings) override {
        if (std::exchange(has_new_mass_, false))
            std::fill(particles.m.begin(), particles.m.end(), parameters_.particle_mass);
        timed(kSort, [&] { sort(particles); });
        timed(kDensity, [&] { compute_density(particles); });
        timed(kPressure, [&] { compute_pressure(particles); });
        timed(kForces, [&] { compute_acceleration(particles); });
        timed(kAdvance, [&] { advance(particles, surroundings); });
        ++step_;
        StepReport report;
        timed(kCheck, [&] { report = check(particles, surroundings); });
        return report;
    }

    double time_step() const override { return parameters_.time_step; }
    std::string_view time_step_limit() const override { return "fixed"; }
    double particle_mass() const override { return parameters_.particle_mass; }
    double rest_density() const override { return parameters_.rest_density; }
    double support_radius() const override { return parameters_.support_radius; }
    Vec3 gravity() const override { return parameters_.gravity; }
    const std::vector<ParameterInfo>& parameter_table() const override { return table_; }
    ParameterMap parameters() const override { return to_parameter_map(parameters_); }

    std::optional<ParameterError> set_parameters(const ParameterMap& values) override {
        if (auto error = check_parameters(table_, values)) return error;
        for (const auto& [key, value] : values) overrides_[key] = value;
        use_overrides();
        has_new_mass_ = true;
        return std::nullopt;
    }

    std::string strategy() const override {
        return "candidates of a cell side by side, double precision, " + std::string(isa_name(isa_));
    }
    std::vector<Stage> plan(const Surroundings& surroundings) const override;

    std::optional<std::string> refuse_object(const CollisionObject& object) const override {
        if (object.motion) return "the thesis model cannot move objects by a prescribed motion; use model wcsph";
        if (object.slip != Slip::by_model) return "the thesis model has its own wall response; leave out slip";
        if (std::holds_alternative<Box>(object.shape) || std::holds_alternative<Sphere>(object.shape)) return {};
        return "the thesis model knows boxes and spheres only; use model wcsph";
    }

    std::optional<std::string> refuse_domain(const Domain& domain) const override {
        if (domain.has_periodic_axis()) return "the thesis model has no periodic axes; use model wcsph";
        return {};
    }

    std::optional<std::string> refuse_body_force() const override {
        return "the thesis model knows gravity only; use model wcsph";
    }

  private:
    void use_overrides() {
        parameters_ = make_thesis_parameters(dimensions_, spacing_, overrides_);
        force_sum_ = choose_force_sum(
            dimensions_, {parameters_.pressure_form, parameters_.viscosity > 0.0, parameters_.surface_tension > 0.0},
            isa_);
    }

    template <class Work>
    void timed(StageIndex stage, Work&& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        seconds_[stage] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    SumInput sum_input(const Particles& particles) const {
        return {grid_, parameters_, particles, volume_.data(), step_};
    }

    void sort(Particles& particles) {
        grid_.sort(particles, parameters_.support_radius);
        candidates_.resize(static_cast<std::size_t>(max_threads()));
    }

    void compute_density(Particles& particles) {
        const SumInput in = sum_input(particles);
        parallel_for(grid_.cells(), kCellBlock, [&](std::size_t first, std::size_t last, int thread) {
            density_sum_(in, first, last, candidates_[thread], particles.rho.data());
        });
    }

    void compute_pressure(Particles& particles) {
        volume_.resize(particles.size());
        parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                particles.p[i] = linear_pressure(particles.rho[i], parameters_.rest_density, parameters_.stiffness);
                volume_[i] = parameters_.particle_mass / particles.rho[i];
            }
        });
    }

    void compute_acceleration(Particles& particles) {
        const SumInput in = sum_input(particles);
        const std::array<double*, 3> a{particles.a[0].data(), particles.a[1].data(), particles.a[2].data()};
        parallel_for(grid_.cells(), kCellBlock, [&](std::size_t first, std::size_t last, int thread) {
            force_sum_(in, first, last, candidates_[thread], a);
        });
    }

    void start_leap(Particles& particles) const {
        for (int k = 0; k < dimensions_; ++k) {
            for (std::size_t i = 0; i < particles.size(); ++i) {
                particles.v_half[k][i] = leap_start(particles.v[k][i], particles.a[k][i], parameters_.time_step);
            }
        }
    }

    void advance(Particles& particles, const Surroundings& surroundings) {
        if (dimensions_ == 3) {
            advance_in<3>(particles, surroundings);
        } else {
            advance_in<2>(particles, surroundings);
        }
        dt_before_ = parameters_.time_step;
    }

    // Leap (2.33, 2.34), collide (2.38-2.51), form v (2.36).
    template <int D>
    void advance_in(Particles& particles, const Surroundings& surroundings) const {
        const double dt = parameters_.time_step;
        const Collider<D> collider(surroundings.objects, parameters_.restitution, dt);
        const bool has_objects = !collider.is_empty();
        parallel_for(particles.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                Point<D> x0, x, v_before, v_after;
                for (int k = 0; k < D; ++k) {
                    x0[k] = particles.x[k][i];
                    v_before[k] = particles.v_half[k][i];
                    v_after[k] = leap_velocity(v_before[k], particles.a[k][i], dt_before_, dt);
                    x[k] = leap_position(x0[k], v_after[k], dt);
                }
                if (has_objects) collider.apply(x0, x, v_after);
                for (int k = 0; k < D; ++k) {
                    particles.x[k][i] = x[k];
                    particles.v_half[k][i] = v_after[k];
                    particles.v[k][i] = mean_velocity(v_before[k], v_after[k]);
                }
            }
        });
    }

    StepReport check(const Particles& particles, const Surroundings& surroundings) const {
        Inspection found = solver::inspect(particles, surroundings.domain);
        if (found.fault) found.fault->remedy = make_remedy(found, surroundings);
        return {.dt = parameters_.time_step, .max_speed = found.max_speed, .fault = std::move(found.fault)};
    }

    std::string make_remedy(const Inspection& found, const Surroundings& surroundings) const;

    int dimensions_;
    double spacing_;  // [m]
    std::vector<ParameterInfo> table_;
    ParameterMap overrides_;  // all values ever set by the caller; the rest follows from them
    ThesisParameters parameters_;
    Isa isa_;
    DensitySum density_sum_;
    ForceSum force_sum_{};

    bool has_new_mass_{false};
    std::uint64_t step_{0};
    double dt_before_{};  // [s] step by which the carried leap velocity is half behind
    CellGrid grid_;
    std::vector<double> volume_;          // [m^3] m / rho of the step just done
    std::vector<Candidates> candidates_;  // one per thread
    std::array<double, kStageCount> seconds_{};
};

std::string Thesis::make_remedy(const Inspection& found, const Surroundings& surroundings) const {
    const StepLimit limit = find_step_limit({dimensions_, parameters_.support_radius, parameters_.stiffness,
                                             parameters_.viscosity, parameters_.particle_mass, found.max_speed});
    const bool is_too_long = parameters_.time_step > limit.dt;
    char advice[160];
    if (is_too_long) {
        std::snprintf(advice, sizeof advice, "reduce time_step below %.3g s (%.*s limit)", limit.dt,
                      static_cast<int>(limit.criterion.size()), limit.criterion.data());
    } else {
        std::snprintf(advice, sizeof advice, "check the particle's initial state, or reduce time_step below %.3g s",
                      0.5 * parameters_.time_step);
    }
    if (found.fault->kind == FaultKind::non_finite) return advice;
    const bool has_container = std::any_of(surroundings.objects.begin(), surroundings.objects.end(),
                                           [](const auto& object) { return object.role == Role::container; });
    const std::string room = has_container ? "enlarge domain so that it holds the containers"
                                           : "enlarge domain, or add a container that holds the fluid";
    return is_too_long ? room + "; " + advice : room;
}

std::vector<Stage> Thesis::plan(const Surroundings& surroundings) const {
    const std::string with_pressure = "; timed with pressure_force, one loop";
    const bool is_viscous = parameters_.viscosity > 0.0, has_tension = parameters_.surface_tension > 0.0;
    const bool has_gravity = parameters_.gravity != Vec3{};
    const bool has_objects = !surroundings.objects.empty();
    const auto skipped = [](const char* name, const char* why) { return Stage{name, false, why, 0.0}; };
    return {
        {"neighbours", true, strategy() + (dimensions_ == 3 ? "; cells in 3D" : "; cells in 2D"), seconds_[kSort]},
        {"density", true, "sum over neighbours", seconds_[kDensity]},
        {"pressure", true, "state equation", seconds_[kPressure]},
        {"pressure_force", true, parameters_.pressure_form == PressureForm::mean ? "mean form" : "symmetric form",
         seconds_[kForces]},
        is_viscous ? Stage{"viscosity", true, "viscosity > 0" + with_pressure}
                   : skipped("viscosity", "coefficient is 0"),
        has_tension ? Stage{"surface_tension", true, "surface_tension > 0" + with_pressure}
                    : skipped("surface_tension", "coefficient is 0"),
        has_gravity ? Stage{"gravity", true, "acceleration" + with_pressure} : skipped("gravity", "vector is 0"),
        {"integrate", true, "leap-frog", seconds_[kAdvance]},
        has_objects ? Stage{"collide", true, "objects in the scene; timed with integrate"}
                    : skipped("collide", "no objects"),
        {"check", true, "bad numbers, domain", seconds_[kCheck]},
    };
}

}  // namespace

std::unique_ptr<Model> make_thesis(int dimensions, double spacing, const ParameterMap& overrides) {
    return std::make_unique<Thesis>(dimensions, spacing, overrides);
}

}  // namespace headrace::solver
