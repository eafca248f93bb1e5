#include "client/probe_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace headrace::client {

namespace {

// The straight piece of one run's curve over a span that lies between two of its samples.
struct Piece {
    double begin{}, end{};  // values at the ends of the span
};

// Walks along a curve, span by span.
class Walker {
  public:
    explicit Walker(const Curve& curve) : curve_(curve) {}

    // The piece from t0 to t1; nothing where a sample it lies between has no value. Spans ascend.
    std::optional<Piece> piece(double t0, double t1) {
        while (at_ + 2 < curve_.time.size() && curve_.time[at_ + 1] <= t0) ++at_;
        const std::optional<double>&v0 = curve_.value[at_], &v1 = curve_.value[at_ + 1];
        if (!v0 || !v1) return std::nullopt;
        const double begin = curve_.time[at_], slope = (*v1 - *v0) / (curve_.time[at_ + 1] - begin);
        return Piece{*v0 + slope * (t0 - begin), *v0 + slope * (t1 - begin)};
    }

  private:
    const Curve& curve_;
    std::size_t at_{0};
};

// The sample times of all runs within the time they have in common.
std::vector<double> common_times(std::span<const Curve> runs) {
    double first = -std::numeric_limits<double>::infinity(), last = -first;
    for (const Curve& run : runs) {
        if (run.time.empty()) return {};
        first = std::max(first, run.time.front());
        last = std::min(last, run.time.back());
    }
    std::vector<double> times;
    for (const Curve& run : runs)
        std::copy_if(run.time.begin(), run.time.end(), std::back_inserter(times),
                     [&](double t) { return t >= first && t <= last; });
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

// All runs have this one instant in common.
Comparison compare_instant(std::span<const Curve> runs, double time) {
    Comparison instant;
    for (const Curve& run : runs) {
        // A curve through the instant: its last sample up to then. (Some run has its only or outermost one there.)
        const auto after = std::upper_bound(run.time.begin(), run.time.end(), time);
        const auto& value = run.value[static_cast<std::size_t>(after - run.time.begin()) - 1];
        if (!value) return {};
        instant.values.push_back({*value});
    }
    instant.weights = {1.0};
    instant.covered = 1.0;
    return instant;
}

struct Span {
    double length{};            // [s]
    bool is_last{};             // it ends with the common time
    std::vector<Piece> pieces;  // by run
};

double number_of(const std::vector<Span>& spans, std::size_t run, double total, Measure measure) {
    double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Span& span : spans) {
        const auto [a, b] = span.pieces[run];
        low = std::min({low, a, b});
        high = std::max({high, a, b});
        const double share = span.length / total;
        // Integrals of a straight piece and of its square.
        sum += share * (measure == Measure::rms ? (a * a + a * b + b * b) / 3 : (a + b) / 2);
    }
    switch (measure) {
        case Measure::min:
            return low;
        case Measure::max:
            return high;
        case Measure::rms:
            return std::sqrt(sum);
        case Measure::last:
            return spans.back().pieces[run].end;
        case Measure::curve:
        case Measure::mean:
            break;
    }
    return sum;
}

// Two Gauss points in each span: exact for squares of differences of straight pieces.
void take_curves(const std::vector<Span>& spans, double total, Comparison& comparison) {
    const double offset = 0.5 / std::sqrt(3.0);
    for (const Span& span : spans)
        for (const double place : {0.5 - offset, 0.5 + offset}) {
            comparison.weights.push_back(0.5 * span.length / total);
            for (std::size_t run = 0; run < comparison.values.size(); ++run)
                comparison.values[run].push_back(std::lerp(span.pieces[run].begin, span.pieces[run].end, place));
        }
}

}  // namespace

Curve curve_of(const proto::ProbeSeries& series, std::size_t column) {
    Curve curve;
    for (const proto::ProbeRow& row : series.rows) {
        if (column >= row.size() || !row[0]) continue;
        curve.time.push_back(*row[0]);
        curve.value.push_back(row[column]);
    }
    return curve;
}

Comparison compare(std::span<const Curve> runs, Measure measure) {
    const std::vector<double> times = common_times(runs);
    if (times.empty()) return {};
    if (times.size() == 1) return compare_instant(runs, times.front());

    std::vector<Walker> walkers(runs.begin(), runs.end());
    std::vector<Span> spans;
    double total = 0;
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        Span span{times[k + 1] - times[k], k + 2 == times.size(), {}};
        for (Walker& walker : walkers)
            if (const auto piece = walker.piece(times[k], times[k + 1])) span.pieces.push_back(*piece);
        if (span.pieces.size() != runs.size()) continue;
        total += span.length;
        spans.push_back(std::move(span));
    }
    if (spans.empty() || (measure == Measure::last && !spans.back().is_last)) return {};

    Comparison comparison;
    comparison.values.resize(runs.size());
    comparison.covered = total / (times.back() - times.front());
    if (measure == Measure::curve) {
        take_curves(spans, total, comparison);
        return comparison;
    }
    for (std::size_t run = 0; run < runs.size(); ++run)
        comparison.values[run] = {number_of(spans, run, total, measure)};
    comparison.weights = {1.0};
    return comparison;
}

Comparison combine(std::span<const Comparison> parts) {
    Comparison whole;
    const auto usable =
        std::count_if(parts.begin(), parts.end(), [](const Comparison& part) { return !part.values.empty(); });
    for (const Comparison& part : parts) {
        if (part.values.empty()) continue;
        whole.values.resize(part.values.size());
        for (std::size_t run = 0; run < part.values.size(); ++run)
            whole.values[run].insert(whole.values[run].end(), part.values[run].begin(), part.values[run].end());
        for (const double weight : part.weights) whole.weights.push_back(weight / static_cast<double>(usable));
        whole.covered += part.covered / static_cast<double>(parts.size());
    }
    return whole;
}

}  // namespace headrace::client
