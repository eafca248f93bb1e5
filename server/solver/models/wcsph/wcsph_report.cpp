#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

#include "server/solver/models/wcsph/solid_loads.h"
#include "server/solver/models/wcsph/sound_speed.h"
#include "server/solver/models/wcsph/wcsph_model.h"
#include "server/solver/neighbours.h"
#include "server/solver/parallel.h"

namespace headrace::solver {

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
    for (const char* name : {"gravity", "viscosity", "surface_tension", "rest_density", "sound_speed",
                             "reference_speed", "reference_length"})
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
    make_sums();
    walls_ = WallField(dimensions_, spacing_, support_);
    place_walls(surroundings, surroundings.time, true);
    const double c0_before = c0_;
    // Only when what the rule depends on has changed: its speeds are those of now.
    if (std::exchange(has_new_stiffness_, false)) {
        put_body_force(particles, surroundings);  // compute_state() gives them their accelerations again
        c0_ = choose_sound_speed(p_, particles, spacing_, walls_.max_speed());
    }
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
        if (!domain.periodic[k] || fits_period(domain.max[k] - domain.min[k], period_unit())) continue;
        char text[160];
        std::snprintf(text, sizeof text,
                      "the domain is periodic along axis %d but shorter than three times %.4g m; enlarge it or "
                      "reduce the spacing",
                      k, period_unit());
        return text;
    }
    return std::nullopt;
}

// Tried out: how many wall particles they need is known when they have been made.
std::optional<std::string> Wcsph::refuse_objects(std::span<const CollisionObject> objects, const Domain& domain,
                                                 double t) const {
    const double support = p_.support_over_spacing * spacing_;
    const WallChoice choice = WallField::choose(objects, domain, dimensions_, support, wall_options());
    try {
        Walls(dimensions_, spacing_, support).rebuild(objects, domain, t, choice.is_integral);
    } catch (const std::length_error& problem) {
        return problem.what();
    }
    return std::nullopt;
}

std::string Wcsph::strategy() const {
    const char* const precision =
        neighbours_->arithmetic() == Arithmetic::double_precision ? "double precision" : "single precision";
    return "clusters of 4 x 4, " + std::string(precision) + ", " + isa_;
}

namespace {

std::string text_of(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string text_of(const char* format, ...) {
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

const char* name_of(DensityDiffusion form) {
    switch (form) {
        case DensityDiffusion::molteni_colagrossi:
            return "molteni_colagrossi";
        case DensityDiffusion::fourtakas:
            return "fourtakas";
        case DensityDiffusion::antuono:
            return "antuono";
        case DensityDiffusion::none:
            break;
    }
    return "none";
}

}  // namespace

std::string Wcsph::walls_reason() const {
    std::string what;
    if (!walls_.integrals().is_empty())
        what = walls_.size() == 0 ? "integrals of the kernel" : "integrals of the kernel beside ";
    if (walls_.size() > 0) what += "pressure of " + std::to_string(walls_.size()) + " wall particles";
    if (!walls_.choice_remark().empty()) what += " (" + walls_.choice_remark() + ")";
    return what + "; " + std::to_string(put_back_) + " fluid particles put back on a surface so far";
}

// A stage that is fused with another says so: its time is counted there.
std::vector<Stage> Wcsph::plan(const Surroundings& surroundings) const {
    std::vector<Stage> stages;
    // Done or skipped, and why.
    const auto add = [&](const char* name, bool is_active, std::string done, const char* skipped, double seconds) {
        stages.push_back({name, is_active, is_active ? std::move(done) : skipped, seconds});
    };
    const bool has_walls = !walls_.is_empty();
    const char* const no_walls = "no objects";
    const std::string sorts = sorts_ == 1 ? "once" : text_of("%llu times", static_cast<unsigned long long>(sorts_));
    const char* const pairs = separated_ == 1 ? "pair" : "pairs";
    add("neighbours", true,
        strategy() +
            text_of("; lists reach %.2g spacings beyond the support, pruned %.2g, and serve while they cover "
                    "all pairs: sorted %s so far, %.0f listed a particle; %llu coincident %s moved apart so far",
                    skin(), inner_skin(), sorts.c_str(), neighbours_->neighbours_per_particle(),
                    static_cast<unsigned long long>(separated_), pairs),
        "", seconds_[kNeighbours]);
    add("geometry", true, "moment matrices, free surface", "", seconds_[kGeometry]);
    add("shifting", has_shifting(), "sums timed with geometry, one loop",
        p_.shifting ? "shifting_factor or shifting_limit is 0" : "shifting is false", seconds_[kShifting]);
    add("gravity", true, p_.gravity != Vec3{} ? "acceleration" : "vector is 0: clears the sum of forces", "",
        seconds_[kGravity]);
    add("body_force", surroundings.body_force != nullptr, "of the scene, at the middle of the step",
        "the scene has none", seconds_[kBodyForce]);
    add("viscosity", p_.viscosity > 0.0, is_morris() ? "morris form" : "monaghan_gingold form", "coefficient is 0",
        seconds_[kViscosity]);
    add("surface_tension", p_.surface_tension > 0.0,
        p_.tension_form == TensionForm::continuum ? "continuum form" : "thesis form", "coefficient is 0",
        seconds_[kTension]);
    add("wall_motion", walls_.has_moving(), "places of moving wall particles", has_walls ? "no object moves" : no_walls,
        seconds_[kWallMotion]);
    add("continuity", true, "rate of the density", "", seconds_[kContinuity]);
    add("density_diffusion", diffusion() != DensityDiffusion::none,
        std::string(name_of(diffusion())) + " form; timed with continuity, one loop",
        p_.density_diffusion == DiffusionForm::none ? "form is none" : "factor is 0", 0.0);
    add("walls", has_walls, walls_reason(), no_walls, seconds_[kWalls]);
    add("pressure_force", true, is_adjoint() ? "adjoint form" : "difference form", "", seconds_[kPressure]);
    add("artificial_viscosity", artificial_viscosity() != 0.0, "timed with pressure_force, one loop",
        p_.artificial_viscosity > 0.0 ? "the fluid's own viscosity does it all" : "coefficient is 0", 0.0);
    add("advance", true, "kick, drift, state equation", "", seconds_[kAdvance]);
    add("energies", energies_.is_on(), "a probe follows them; timed with the other stages", "no probe follows them",
        0.0);
    add("check", true, "bad numbers, health, next step", "", seconds_[kCheck]);
    return stages;
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
    const WcsphView seen = view(particles);
    const TermOptions options = term_options();
    const std::vector<WallForce> forces = compute_wall_forces(load_input(surroundings), seen, *sums_, options);
    std::vector<ObjectLoad> known = sum_object_loads(walls_.particles(), forces, object_names_.size());
    if (!walls_.integrals().is_empty()) add_solid_loads(seen, record_solid_sums(particles), options, known);
    for (std::size_t o = 0; o < loads.size(); ++o) {
        const auto found = std::find(object_names_.begin(), object_names_.end(), surroundings.objects[o].name);
        if (found != object_names_.end()) loads[o] = known[static_cast<std::size_t>(found - object_names_.begin())];
    }
    return loads;
}

SolidSums Wcsph::record_solid_sums(const Particles& particles) const {
    SolidSums sums;
    sums.objects.resize(object_names_.size());
    for (SolidSums::OfObject& object : sums.objects) {
        for (VectorField* field : {&object.grad_1, &object.pB_grad})
            for (int k = 0; k < dimensions_; ++k) (*field)[k].assign(particles.size(), 0.0);
    }
    // Copies, since the pass writes accelerations.
    Particles scratch = particles;
    WcsphState state = state_;
    WallState wall_state = walls_.state();
    PassData data{scratch, state, walls_.particles(), wall_state, solid_view()};
    data.solid.record = &sums;
    sums_->pressure(data, is_adjoint(), pressure_options());
    return sums;
}

// Walls at rest do no work: they are not asked.
WallPower Wcsph::wall_power(const Particles& particles, const Surroundings& surroundings) const {
    if (walls_.is_empty() || walls_.max_speed() == 0.0) return {};
    return compute_wall_power(walls_.particles(),
                              compute_wall_forces(load_input(surroundings), view(particles), *sums_, term_options()));
}

// The first kick still has the acceleration of the step before, which nobody has taken apart: its parts are taken to
// be those of the present state.
void Wcsph::start_energies(Particles& particles, const Surroundings& surroundings) {
    const VectorField a = particles.a;
    compute_pressure(particles, surroundings);
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

}  // namespace headrace::solver
