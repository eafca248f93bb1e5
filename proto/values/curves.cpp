#include "proto/values/curves.h"

#include <cmath>
#include <limits>

namespace headrace::scene {

using proto::Result;

namespace {

// [s] Not multiples of each other: with those an oscillation whose period divides two steps would look still to both.
constexpr std::array kSteps{1e-2, 1.0132e-3, 1.0266e-4, 1.0402e-5, 1.0539e-6};

// Of neighbouring estimates that agree best the one with the smaller step: where they do, both errors are small, and
// truncation is what the smaller step has less of. Not a number when fewer than two are.
double best_of(const std::array<double, kSteps.size()>& estimates) {
    double best = std::numeric_limits<double>::quiet_NaN(), smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < estimates.size(); ++k) {
        const double difference = std::abs(estimates[k + 1] - estimates[k]);
        if (!(difference < smallest)) continue;
        smallest = difference;
        best = estimates[k + 1];
    }
    return best;
}

}  // namespace

double Curve::value(double t) const {
    return table_ ? table_->at(column_, t).value : formula_({}, t);
}

CurvePoint Curve::at(double t) const {
    if (table_) return table_->at(column_, t);
    const double here = formula_({}, t);
    if (formula_.is_constant()) return {here};
    std::array<double, kSteps.size()> rates, accelerations;
    for (std::size_t k = 0; k < kSteps.size(); ++k) {
        // The step that t can really take: t + h - t is not h in floating point.
        const volatile double ahead = t + kSteps[k];
        const double h = ahead - t;
        const double m2 = formula_({}, t - 2 * h), m1 = formula_({}, t - h);
        const double p1 = formula_({}, t + h), p2 = formula_({}, t + 2 * h);
        rates[k] = (m2 - p2 + 8 * (p1 - m1)) / (12 * h);
        accelerations[k] = (16 * (m1 + p1) - (m2 + p2) - 30 * here) / (12 * h * h);
    }
    return {here, best_of(rates), best_of(accelerations)};
}

Result<Curve> make_curve(const ScalarOverTime& desc, double spacing, const std::string& path) {
    if (const auto* rows = std::get_if<proto::TableDesc>(&desc)) {
        Result<Table> table = Table::make(*rows, 1, path);
        if (!table) return table.error();
        return Curve(std::make_shared<const Table>(std::move(*table)), 0);
    }
    Result<Formula> formula = Formula::compile(std::get<proto::Scalar>(desc), {.spacing = spacing, .time = true}, path);
    if (!formula) return formula.error();
    return Curve(std::move(*formula));
}

Result<std::array<Curve, 3>> make_curves(const VectorOverTime& desc, int dimensions, double spacing,
                                         const std::string& path) {
    std::array<Curve, 3> curves;
    if (const auto* rows = std::get_if<proto::TableDesc>(&desc)) {
        Result<Table> table = Table::make(*rows, dimensions, path, dimensions == 2);
        if (!table) return table.error();
        const auto shared = std::make_shared<const Table>(std::move(*table));
        for (int k = 0; k < dimensions; ++k) curves[k] = Curve(shared, k);
        return curves;
    }
    const Symbols symbols{.dimensions = dimensions, .spacing = spacing, .time = true};
    auto formulas = compile_vector(std::get<proto::ScalarVec3>(desc), symbols, path);
    if (!formulas) return formulas.error();
    for (int k = 0; k < dimensions; ++k) curves[k] = Curve(std::move((*formulas)[k]));
    return curves;
}

}  // namespace headrace::scene
