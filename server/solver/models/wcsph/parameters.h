// Parameters of the wcsph model: which physics (the scene's), which numerics (defaults; all can be overridden).
#pragma once

#include <vector>

#include "server/solver/forces/density_diffusion.h"
#include "server/solver/forces/laminar_viscosity.h"
#include "server/solver/forces/pressure_gradient.h"
#include "server/solver/objects.h"
#include "server/solver/parameters.h"
#include "server/solver/smoothing_kernels.h"

namespace headrace::solver {

enum class StateEquationKind { linear, tait };
enum class DiffusionForm { automatic, none, molteni_colagrossi, fourtakas, antuono };
enum class TensionForm { continuum, thesis };
enum class ArtificialViscosity { reconstructed, monaghan };
enum class WallSuction { automatic, allowed, clamped };
enum class WallKind { automatic, particles, integrals };
enum class Precision { automatic, single_precision, double_precision };

struct WcsphParameters {
    // physics
    Vec3 gravity{0.0, -9.81, 0.0};  // [m/s^2]
    double rest_density{1000.0};    // rho0 [kg/m^3]
    double viscosity{0.0};          // mu [Pa s]
    double surface_tension{0.0};    // sigma [N/m]
    bool free_surface{true};
    Slip wall_slip{Slip::free_slip};

    // stiffness of the fluid
    double sound_speed{0.0};       // c0 [m/s]; 0: by rule
    double reference_speed{0.0};   // [m/s]; 0: estimated
    double reference_length{0.0};  // [m]; 0: the fluid's extent
    StateEquationKind state_equation{StateEquationKind::linear};

    // numerics
    KernelKind kernel{KernelKind::wendland_c2};
    double support_over_spacing{3.0};  // R/dx [1]
    PressureGradient pressure_gradient{PressureGradient::automatic};
    double correction_threshold{0.9};  // smallest eigenvalue from which B is used
    DiffusionForm density_diffusion{DiffusionForm::automatic};
    double density_diffusion_factor{0.05};  // xi [1]
    double artificial_viscosity{0.03};      // alpha [1]
    ArtificialViscosity artificial_viscosity_form{ArtificialViscosity::reconstructed};
    ViscosityForm viscosity_form{ViscosityForm::automatic};
    TensionForm tension_form{TensionForm::continuum};
    bool shifting{true};
    double shifting_factor{1.0};  // C [1]
    double shifting_limit{0.05};  // [spacings] per step
    bool tension_control{true};
    WallKind walls{WallKind::automatic};
    WallSuction wall_suction{WallSuction::automatic};
    Precision precision{Precision::automatic};  // of the pair sums

    // time
    double time_step{0.0};  // [s]; 0: by the criteria
    double cfl{0.6};        // acoustic Courant number on h
    double advective_cfl{0.25};
    bool dual_time_step{true};
    double most_acoustic_steps{5.0};  // per step
};

std::vector<ParameterInfo> wcsph_parameter_table(int dimensions, double spacing);

// Defaults, then the overrides. Precondition: check_parameters() accepts them.
WcsphParameters make_wcsph_parameters(const ParameterMap& overrides);

ParameterMap to_parameter_map(const WcsphParameters& parameters);

}  // namespace headrace::solver
