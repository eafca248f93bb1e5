#include "client/convergence_report.h"

#include <algorithm>
#include <cmath>

namespace headrace::client {

namespace {

constexpr const char* kMeasureNames[] = {"curve", "last", "mean", "min", "max", "rms"};  // as the enumerators

// A single number as it is, with its sign; a curve as its root mean square.
double shown(const Values& values, const Values& weights) {
    return values.size() == 1 ? values.front() : weighted_norm(values, weights);
}

std::vector<const StudyRun*> runs_of(const Study& study) {
    std::vector<const StudyRun*> runs;
    for (const StudyRun& run : study.runs) runs.push_back(&run);
    if (study.faster) runs.push_back(&*study.faster);
    return runs;
}

Comparison compare_column(const Study& study, std::size_t probe, std::size_t column) {
    std::vector<Curve> curves;
    for (const StudyRun* run : runs_of(study)) curves.push_back(curve_of(run->probes[probe], column));
    return compare(curves, study.measure);
}

StudyRow evaluate_row(const Study& study, const Comparison& comparison, StudyRow row) {
    row.covered = comparison.covered;
    row.is_compared = !comparison.values.empty();
    if (!row.is_compared) return row;
    const Values& weights = comparison.weights;
    std::array<double, 3> spacings{};
    std::array<Values, 3> values;
    for (std::size_t k = 0; k < 3; ++k) {
        spacings[k] = study.runs[k].spacing;
        values[k] = comparison.values[k];
        row.values[k] = shown(values[k], weights);
    }
    row.resolution = estimate_resolution(spacings, values, weights);
    row.total_error = row.resolution.error;
    if (!row.resolution.extrapolated.empty()) row.extrapolated = shown(row.resolution.extrapolated, weights);
    if (study.faster) {
        const Values& faster = comparison.values[3];
        row.faster = shown(faster, weights);
        const double factor = *study.faster->sound_speed / *study.runs[kMiddle].sound_speed;
        row.compressibility_error = estimate_compressibility(values[kMiddle], faster, weights, factor);
        row.total_error += *row.compressibility_error;
    }
    return row;
}

}  // namespace

std::string measure_name(Measure measure) {
    return kMeasureNames[static_cast<std::size_t>(measure)];
}

std::optional<Measure> find_measure(const std::string& name) {
    const auto found = std::find(std::begin(kMeasureNames), std::end(kMeasureNames), name);
    if (found == std::end(kMeasureNames)) return std::nullopt;
    return static_cast<Measure>(found - std::begin(kMeasureNames));
}

std::vector<StudyRow> evaluate(const Study& study) {
    std::vector<StudyRow> rows;
    for (std::size_t k = 0; k < study.runs[kFine].probes.size(); ++k) {
        const proto::ProbeSeries& series = study.runs[kFine].probes[k];
        const bool is_profile = series.columns.size() > 1 && series.columns[1].position.has_value();
        std::vector<Comparison> columns;
        for (std::size_t c = 1; c < series.columns.size(); ++c) columns.push_back(compare_column(study, k, c));
        if (is_profile) {
            StudyRow whole{series.name, "profile", series.columns[1].unit};
            rows.push_back(evaluate_row(study, combine(columns), whole));
        }
        for (std::size_t c = 1; c < series.columns.size(); ++c) {
            const proto::ProbeColumn& column = series.columns[c];
            StudyRow row{series.name, column.name, column.unit, column.position, is_profile};
            rows.push_back(evaluate_row(study, columns[c - 1], row));
        }
    }
    return rows;
}

}  // namespace headrace::client
