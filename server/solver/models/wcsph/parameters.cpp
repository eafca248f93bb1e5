#include "server/solver/models/wcsph/parameters.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace headrace::solver {
namespace {

// One row per parameter: everything else follows from these rows.
struct Row {
    const char* name;
    const char* unit;
    const char* meaning;
    double min{0.0};
    double max{std::numeric_limits<double>::infinity()};
    bool min_is_exclusive{false};
};

using P = WcsphParameters;

struct NumberRow : Row {
    double P::*member;
};
struct FlagRow : Row {
    bool P::*member;
};
// Enumerators count from `first`, in the order of the names.
template <class Enum>
struct ChoiceRow : Row {
    Enum P::*member;
    std::vector<std::string> names;
    int first{0};
};

constexpr double kNoBound = std::numeric_limits<double>::infinity();

const NumberRow kNumbers[] = {
    {{"rest_density", "kg/m^3", "Density rho0 without pressure.", 0.0, kNoBound, true}, &P::rest_density},
    {{"viscosity", "Pa s", "Dynamic viscosity mu; 0: an inviscid fluid."}, &P::viscosity},
    {{"surface_tension", "N/m", "Surface tension sigma; 0: none."}, &P::surface_tension},
    {{"sound_speed", "m/s",
      "Numerical speed of sound c0; 0: the largest of 10 reference_speed, 10 sqrt(F L), 10 sqrt(nu V/L) and "
      "10 sqrt(sigma/(rho0 dx)), with the body force F, the reference length L and speed V."},
     &P::sound_speed},
    {{"reference_speed", "m/s",
      "Largest speed expected; 0: the larger of the fastest particle or wall at the start and sqrt(2 |g| H), H the "
      "fluid's height."},
     &P::reference_speed},
    {{"reference_length", "m", "Length L of the rule for sound_speed; 0: the fluid's extent along gravity."},
     &P::reference_length},
    {{"support_over_spacing", "1", "Support radius R of the kernel in spacings; the smoothing length is h = R/2.", 1.5,
      6.0},
     &P::support_over_spacing},
    {{"correction_threshold", "1",
      "Smallest eigenvalue of the moment matrix from which the gradient is corrected; below lies a free surface.", 0.0,
      2.0},
     &P::correction_threshold},
    {{"density_diffusion_factor", "1", "Strength xi of the density diffusion.", 0.0, 1.0},
     &P::density_diffusion_factor},
    {{"artificial_viscosity", "1",
      "Strength alpha of the artificial viscosity, which the fluid's own viscosity replaces in part or whole; 0: none.",
      0.0, 10.0},
     &P::artificial_viscosity},
    {{"shifting_factor", "1", "Strength C of the particle shifting.", 0.0, 10.0}, &P::shifting_factor},
    {{"shifting_limit", "1", "Longest shift in a step, in spacings.", 0.0, 0.25}, &P::shifting_limit},
    {{"time_step", "s", "Step; 0: by the criteria that time_step_limit names."}, &P::time_step},
    {{"cfl", "1", "Courant number of the acoustic step: c dt/h.", 0.0, 10.0, true}, &P::cfl},
    {{"advective_cfl", "1", "Courant number of the step: v dt/h, and of the other slow criteria.", 0.0, 10.0, true},
     &P::advective_cfl},
    {{"most_acoustic_steps", "1", "Acoustic steps in a step, at most.", 1.0, 100.0}, &P::most_acoustic_steps},
};

const FlagRow kFlags[] = {
    {{"free_surface", "1",
      "true: the fluid may have a free surface; false: it fills its walls or periods, negative pressures included."},
     &P::free_surface},
    {{"shifting", "1", "Spread the particles evenly by shifting."}, &P::shifting},
    {{"tension_control", "1",
      "Replace the attraction of pairs under negative pressure inside the fluid (against clumping)."},
     &P::tension_control},
    {{"dual_time_step", "1", "Several acoustic steps in an advective one; false: one."}, &P::dual_time_step},
};

const ChoiceRow<StateEquationKind> kStateEquation{
    {"state_equation", "1", "p = c0^2 (rho - rho0), or Tait's with exponent 7."},
    &P::state_equation,
    {"linear", "tait"}};
const ChoiceRow<KernelKind> kKernel{{"kernel", "1", "Smoothing kernel; wendland_c2 is the fast one."},
                                    &P::kernel,
                                    {"wendland_c2", "wendland_c4", "cubic_spline", "quintic_spline"}};
const ChoiceRow<PressureGradient> kGradient{
    {"pressure_gradient", "1",
     "Form of the pressure force: adjoint (conserves momentum and energy), difference (exact for linear pressure), "
     "plain (no gradient correction); automatic: adjoint at free surfaces, difference in confined flow."},
    &P::pressure_gradient,
    {"automatic", "difference", "adjoint", "plain"}};
const ChoiceRow<DiffusionForm> kDiffusion{
    {"density_diffusion", "1",
     "Form of the density diffusion; automatic: antuono at free surfaces, fourtakas in confined flow."},
    &P::density_diffusion,
    {"automatic", "none", "molteni_colagrossi", "fourtakas", "antuono"}};
const ChoiceRow<ArtificialViscosity> kArtificial{
    {"artificial_viscosity_form", "1",
     "Form of the artificial viscosity: reconstructed (spares the resolved flow) or monaghan."},
    &P::artificial_viscosity_form,
    {"reconstructed", "monaghan"}};
const ChoiceRow<ViscosityForm> kViscosity{
    {"viscosity_form", "1",
     "Form of the viscosity; automatic: monaghan_gingold at free surfaces, morris in confined flow."},
    &P::viscosity_form,
    {"automatic", "morris", "monaghan_gingold"}};
const ChoiceRow<TensionForm> kTension{
    {"tension_form", "1", "Surface tension: continuum surface force, or the thesis's form for comparison."},
    &P::tension_form,
    {"continuum", "thesis"}};
const ChoiceRow<Slip> kSlip{
    {"wall_slip", "1", "Do walls hold the fluid's tangential velocity? Objects may say otherwise."},
    &P::wall_slip,
    {"free_slip", "no_slip"},
    static_cast<int>(Slip::free_slip)};
const ChoiceRow<WallKind> kWallKind{
    {"walls", "1",
     "What walls are made of: dummy particles, or integrals of the kernel over boxes, spheres and planes along the "
     "axes that rest and do not overlap (other objects stay particles); automatic: integrals in 3D where all objects "
     "allow it, are no spheres and slip; else particles."},
    &P::walls,
    {"automatic", "particles", "integrals"}};
const ChoiceRow<WallSuction> kSuction{
    {"wall_suction", "1", "May walls have negative pressure? automatic: only in confined flow."},
    &P::wall_suction,
    {"automatic", "allowed", "clamped"}};
const ChoiceRow<Precision> kPrecision{
    {"precision", "1",
     "Arithmetic of the pair sums; automatic: single, but double where spacings are below 1e-6 m or above 1e6 m."},
    &P::precision,
    {"automatic", "single", "double"}};

// visit(row) for each row of any kind.
template <class Visit>
void for_each_row(Visit&& visit) {
    for (const NumberRow& row : kNumbers) visit(row);
    for (const FlagRow& row : kFlags) visit(row);
    visit(kStateEquation);
    visit(kKernel);
    visit(kGradient);
    visit(kDiffusion);
    visit(kArtificial);
    visit(kViscosity);
    visit(kTension);
    visit(kSlip);
    visit(kWallKind);
    visit(kSuction);
    visit(kPrecision);
}

ParameterValue value_of(const NumberRow& row, const P& p) {
    return p.*row.member;
}
ParameterValue value_of(const FlagRow& row, const P& p) {
    return p.*row.member;
}
template <class Enum>
ParameterValue value_of(const ChoiceRow<Enum>& row, const P& p) {
    return row.names[static_cast<std::size_t>(static_cast<int>(p.*row.member) - row.first)];
}

void assign(const NumberRow& row, const ParameterValue& value, P& p) {
    p.*row.member = std::get<double>(value);
}
void assign(const FlagRow& row, const ParameterValue& value, P& p) {
    p.*row.member = std::get<bool>(value);
}
template <class Enum>
void assign(const ChoiceRow<Enum>& row, const ParameterValue& value, P& p) {
    const auto& name = std::get<std::string>(value);
    for (std::size_t k = 0; k < row.names.size(); ++k) {
        if (row.names[k] == name) p.*row.member = static_cast<Enum>(row.first + static_cast<int>(k));
    }
}

const std::vector<std::string>& choices_of(const Row&) {
    static const std::vector<std::string> none;
    return none;
}
template <class Enum>
const std::vector<std::string>& choices_of(const ChoiceRow<Enum>& row) {
    return row.names;
}

}  // namespace

std::vector<ParameterInfo> wcsph_parameter_table(int, double) {
    const WcsphParameters defaults;
    std::vector<ParameterInfo> table;
    table.push_back({"gravity", "m/s^2", "Acceleration of gravity.", defaults.gravity});
    for_each_row([&](const auto& row) {
        ParameterInfo info{row.name, row.unit, row.meaning, value_of(row, defaults)};
        if (std::holds_alternative<double>(info.default_value)) {
            info.min = row.min;
            info.max = row.max;
            info.min_is_exclusive = row.min_is_exclusive;
        }
        info.choices = choices_of(row);
        table.push_back(std::move(info));
    });
    return table;
}

WcsphParameters make_wcsph_parameters(const ParameterMap& overrides) {
    WcsphParameters p;
    if (const auto g = overrides.find("gravity"); g != overrides.end()) p.gravity = std::get<Vec3>(g->second);
    for_each_row([&](const auto& row) {
        if (const auto found = overrides.find(row.name); found != overrides.end()) assign(row, found->second, p);
    });
    return p;
}

ParameterMap to_parameter_map(const WcsphParameters& p) {
    ParameterMap map{{"gravity", p.gravity}};
    for_each_row([&](const auto& row) { map.emplace(row.name, value_of(row, p)); });
    return map;
}

}  // namespace headrace::solver
