// Parameters of the thesis model: table, defaults and what follows from what.
#pragma once

#include <string>
#include <vector>

#include "server/solver/forces/pressure.h"
#include "server/solver/parameters.h"

namespace headrace::solver {

struct ThesisParameters {
    Vec3 gravity{};                      // [m/s^2]
    double time_step{};                  // [s]
    double rest_density{};               // rho0 [kg/m^3]
    double particle_mass{};              // m [kg] (2D: kg/m)
    double viscosity{};                  // mu [Pa s]
    double surface_tension{};            // sigma [N/m]
    double surface_tension_threshold{};  // l [1/m]
    double stiffness{};                  // k [J/kg]
    double restitution{};                // c_R [1]
    double support_radius{};             // h [m]
    PressureForm pressure_form{PressureForm::mean};
    bool separate_coincident{true};
};

// Defaults are those of Staubach 2010, Tables 3.1 and 3.2 at the thesis's spacing (m/rho0)^(1/3), and follow another
// spacing as lengths do; see notation.md.
std::vector<ParameterInfo> thesis_parameter_table(int dimensions, double spacing);

// Defaults, then what follows from an override and is not overridden itself (time_step and surface_tension_threshold
// from support_radius, particle_mass from rest_density), then the overrides. Precondition: check_parameters() accepts.
ThesisParameters make_thesis_parameters(int dimensions, double spacing, const ParameterMap& overrides);

ParameterMap to_parameter_map(const ThesisParameters& parameters);

}  // namespace headrace::solver
