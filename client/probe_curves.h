// Curves of a probe from several runs, brought to the same instants: each run samples at times of its own steps.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "client/richardson.h"
#include "proto/messages.h"

namespace headrace::client {

// What of a curve is compared: the whole of it, or one number.
enum class Measure { curve, last, mean, min, max, rms };

// One column of a probe: samples ascending in time, nothing where there was no fluid to measure.
struct Curve {
    std::vector<double> time;  // [s]
    std::vector<std::optional<double>> value;
};

Curve curve_of(const proto::ProbeSeries& series, std::size_t column);  // column 0 is the time

struct Comparison {
    std::vector<Values> values;  // by run; empty: nothing can be compared
    Values weights;              // sum to 1
    double covered{};            // share of the common time in which every run has a value
};

// Between samples curves are straight. The time that all runs have in common is compared, less the spans in which one
// of them has no value; `last` is the value at its end.
Comparison compare(std::span<const Curve> runs, Measure measure);

// Several comparisons of the same runs as one, each with the same weight: the points of a profile. Those that compare
// nothing count as not covered.
Comparison combine(std::span<const Comparison> parts);

}  // namespace headrace::client
