// Is the state of a wcsph run still a result? Stops a run before garbage spreads, names the particle and what helps.
//
//   density: |delta| > 0.5. The fluid is meant to vary by 1 %; here the particles' volumes no longer fill space.
//
//   speed: |v| > 2 c0. Pressure can no longer answer: c0 is meant to be ten times the largest speed.
//
//   time_step: dt < 1e-3 cfl h/c0. Forces 10^5 times those of a violent impact leave nothing to simulate. Where the
//   scene chose the step (viscosity, tension, sound speed): dt < 1e-15 s. In a femtosecond no fluid is a continuum, and
//   the run would never end.
//
// For comparison: the water hammer of a flat impact is delta = |v|/c0, 0.1 where c0 is ten times the speed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/solver/particles.h"
#include "server/solver/step_report.h"

namespace headrace::solver {

inline constexpr double kMostDeviation = 0.5;  // [1]
inline constexpr double kMostMach = 2.0;       // [1]
inline constexpr double kLeastStep = 1e-3;     // [1] of the acoustic step at rest
inline constexpr double kLeastSeconds = 1e-15;

struct Extremes {
    double max_acceleration{};  // [m/s^2] of the finite ones
    std::size_t fastest_changing{};
    double max_deviation{};  // [1] largest |delta|; infinity where one is not a number
    std::size_t most_deviating{};
    std::size_t fastest{};
};
Extremes find_extremes(const Particles& particles, const std::vector<double>& delta);

// What the criteria and the remedies need to know of the run.
struct RunLimits {
    double sound_speed{};            // c0 [m/s]
    double acoustic_step{};          // [s] cfl h/c0
    double next_step{};              // [s]
    std::string_view limit;          // which criterion chose it
    double cfl{};                    // [1]
    double recommended_cfl{};        // [1] the default
    double fixed_step{};             // [s]; 0: none
    bool sound_speed_by_rule{true};  // else the scene gave it
    bool is_confined{};              // the pressure force is the one for fluid without free surface
    bool shifts{true};
};

// The first criterion violated, in the order above. Precondition: all x and v are finite.
std::optional<Fault> check_health(const Particles& particles, const Extremes& extremes, const RunLimits& limits);

// What helps against a fault of any kind.
std::string remedy_for(FaultKind kind, const RunLimits& limits);

}  // namespace headrace::solver
