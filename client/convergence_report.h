// What a convergence study says about each probe: the results at three spacings and two sound speeds, the observed
// order, the extrapolated result and the error bars; as table, CSV and JSON.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "client/probe_curves.h"
#include "client/richardson.h"
#include "proto/messages.h"
#include "proto/messages_json.h"

namespace headrace::client {

struct StudyRun {
    double spacing{};                   // [m]
    std::optional<double> sound_speed;  // [m/s]; nothing: the model has none
    std::int64_t particles{};
    std::int64_t steps{};
    double wall_s{};                         // [s] of the run, without loading
    std::vector<proto::ProbeSeries> probes;  // in the same order in every run
};

struct Study {
    std::string scene;
    int dimensions{};
    double until{};  // [s]
    Measure measure{Measure::curve};
    std::array<StudyRun, 3> runs;    // coarse, middle, fine
    std::optional<StudyRun> faster;  // middle spacing, higher sound speed; nothing: it was not possible
};

// One result: of a column, or of all points of a profile together.
struct StudyRow {
    std::string probe, column, unit;
    std::optional<double> position;  // [m] of a profile's point
    bool is_point{false};            // of a profile, whose row comes first
    std::array<double, 3> values{};  // a curve or a profile: its root mean square
    std::optional<double> faster;
    bool is_compared{false};  // false: there is no time at which all runs have a value; what follows counts for nothing
    ResolutionEstimate resolution;
    std::optional<double> extrapolated;
    std::optional<double> compressibility_error;
    double total_error{};  // resolution and compressibility added up: neither is random
    double covered{};      // share of the common time in which every run has a value
};

std::vector<StudyRow> evaluate(const Study& study);

std::string measure_name(Measure measure);
std::optional<Measure> find_measure(const std::string& name);

// Lines for a person, with what the signs in it mean.
std::string study_table(const Study& study, const std::vector<StudyRow>& rows);
std::string study_csv(const std::vector<StudyRow>& rows);
proto::Json study_json(const Study& study, const std::vector<StudyRow>& rows);

}  // namespace headrace::client
