#include "server/solver/models/thesis_parameters.h"

#include <cmath>

#include "server/solver/kernels.h"

namespace headrace::solver {
namespace {

// Staubach 2010, Tables 3.1 and 3.2 (Kelager 2006).
constexpr double kRestDensity = 998.29;     // [kg/m^3]
constexpr double kParticleMass = 0.02;      // [kg]
constexpr double kSupportRadius = 0.0457;   // [m]
constexpr double kTimeStep = 0.01;          // [s]
constexpr double kThreshold = 7.065;        // [1/m]
constexpr double kViscosity = 3.5;          // [Pa s]
constexpr double kSurfaceTension = 0.0728;  // [N/m]
constexpr double kStiffness = 3.0;          // [J/kg]
constexpr Vec3 kGravity{0.0, -9.82, 0.0};   // [m/s^2]

// The thesis's ratio 1.68 leaves 8 neighbours in 2D; 2.5 gives about 20, as in 3D.
constexpr double kSupportInSpacings2D = 2.5;

// A support beyond this many spacings has thousands of neighbours a particle: a mistyped unit, not a method.
constexpr double kMaxSupportInSpacings = 20.0;

double default_support_radius(int dimensions, double spacing) {
    if (dimensions == 2) return kSupportInSpacings2D * spacing;
    return kSupportRadius / std::cbrt(kParticleMass / kRestDensity) * spacing;
}

double default_time_step(double support_radius) {
    return kTimeStep * (support_radius / kSupportRadius);
}

double default_threshold(double support_radius) {
    return kThreshold * (kSupportRadius / support_radius);
}

double default_particle_mass(int dimensions, double spacing, double rest_density) {
    return rest_density * integer_power(spacing, dimensions);
}

ThesisParameters default_parameters(int dimensions, double spacing) {
    ThesisParameters defaults;
    defaults.gravity = kGravity;
    defaults.rest_density = kRestDensity;
    defaults.viscosity = kViscosity;
    defaults.surface_tension = kSurfaceTension;
    defaults.stiffness = kStiffness;
    defaults.support_radius = default_support_radius(dimensions, spacing);
    defaults.time_step = default_time_step(defaults.support_radius);
    defaults.surface_tension_threshold = default_threshold(defaults.support_radius);
    defaults.particle_mass = default_particle_mass(dimensions, spacing, defaults.rest_density);
    return defaults;
}

std::string form_name(PressureForm form) {
    return form == PressureForm::mean ? "mean" : "symmetric";
}

template <class T>
bool apply_override(const ParameterMap& overrides, const char* name, T& value) {
    const auto found = overrides.find(name);
    if (found == overrides.end()) return false;
    value = std::get<T>(found->second);
    return true;
}

ParameterInfo positive(const char* name, const char* unit, const char* meaning, double value) {
    ParameterInfo info{name, unit, meaning, value};
    info.min = 0.0;
    info.min_is_exclusive = true;
    return info;
}

ParameterInfo not_negative(const char* name, const char* unit, const char* meaning, double value) {
    ParameterInfo info{name, unit, meaning, value};
    info.min = 0.0;
    return info;
}

}  // namespace

std::vector<ParameterInfo> thesis_parameter_table(int dimensions, double spacing) {
    const ThesisParameters d = default_parameters(dimensions, spacing);
    const bool is_flat = dimensions == 2;

    ParameterInfo restitution =
        not_negative("restitution", "1", "Share of the impact given back, c_R of 2.51.", d.restitution);
    restitution.max = 1.0;
    ParameterInfo support = positive(
        "support_radius", "m", "Radius h where every kernel ends; time_step and surface_tension_threshold follow it.",
        d.support_radius);
    support.max = kMaxSupportInSpacings * spacing;
    ParameterInfo form{"pressure_form", "1", "Pressure force: mean (2.22) or symmetric (2.21).",
                       form_name(d.pressure_form)};
    form.choices = {"mean", "symmetric"};

    return {
        {"gravity", "m/s^2",
         is_flat ? "Acceleration of gravity (2.26); the third component has no effect in 2D."
                 : "Acceleration of gravity (2.26).",
         d.gravity},
        positive("time_step", "s", "Step dt of the leap-frog (2.33, 2.34), fixed.", d.time_step),
        positive("rest_density", "kg/m^3", "Density rho0 without pressure (2.19); particle_mass follows it.",
                 d.rest_density),
        positive("particle_mass", is_flat ? "kg/m" : "kg", "Mass m of a particle (2.17).", d.particle_mass),
        not_negative("viscosity", "Pa s", "Dynamic viscosity mu (2.25).", d.viscosity),
        not_negative("surface_tension", "N/m", "Surface tension sigma (2.30).", d.surface_tension),
        not_negative("surface_tension_threshold", "1/m",
                     "Length l of the colour gradient from which a particle counts as surface (2.31).",
                     d.surface_tension_threshold),
        not_negative("stiffness", "J/kg",
                     "Factor k of the state equation p = k (rho - rho0) (2.19), square of the speed of sound.",
                     d.stiffness),
        restitution,
        support,
        form,
        {"separate_coincident", "1",
         "Push particles at one point apart; false: leave them superposed, as the thesis does.", d.separate_coincident},
    };
}

ThesisParameters make_thesis_parameters(int dimensions, double spacing, const ParameterMap& overrides) {
    ThesisParameters p = default_parameters(dimensions, spacing);
    apply_override(overrides, "gravity", p.gravity);
    apply_override(overrides, "viscosity", p.viscosity);
    apply_override(overrides, "surface_tension", p.surface_tension);
    apply_override(overrides, "stiffness", p.stiffness);
    apply_override(overrides, "restitution", p.restitution);
    apply_override(overrides, "separate_coincident", p.separate_coincident);

    apply_override(overrides, "support_radius", p.support_radius);
    p.time_step = default_time_step(p.support_radius);
    p.surface_tension_threshold = default_threshold(p.support_radius);
    apply_override(overrides, "time_step", p.time_step);
    apply_override(overrides, "surface_tension_threshold", p.surface_tension_threshold);

    apply_override(overrides, "rest_density", p.rest_density);
    p.particle_mass = default_particle_mass(dimensions, spacing, p.rest_density);
    apply_override(overrides, "particle_mass", p.particle_mass);

    std::string form = form_name(p.pressure_form);
    apply_override(overrides, "pressure_form", form);
    p.pressure_form = form == "mean" ? PressureForm::mean : PressureForm::symmetric;
    return p;
}

ParameterMap to_parameter_map(const ThesisParameters& p) {
    return {{"gravity", p.gravity},
            {"time_step", p.time_step},
            {"rest_density", p.rest_density},
            {"particle_mass", p.particle_mass},
            {"viscosity", p.viscosity},
            {"surface_tension", p.surface_tension},
            {"surface_tension_threshold", p.surface_tension_threshold},
            {"stiffness", p.stiffness},
            {"restitution", p.restitution},
            {"support_radius", p.support_radius},
            {"pressure_form", form_name(p.pressure_form)},
            {"separate_coincident", p.separate_coincident}};
}

}  // namespace headrace::solver
