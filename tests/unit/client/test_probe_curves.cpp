#include <catch2/catch.hpp>
#include <cmath>

#include "client/probe_curves.h"

using namespace headrace;
using namespace headrace::client;

namespace {

// Straight from sample to sample, so that any times give the same curve: 2 t, with 1 s between kinks or without.
Curve straight(const std::vector<double>& times, double slope, double offset = 0) {
    Curve curve{times, {}};
    for (const double t : times) curve.value.emplace_back(offset + slope * t);
    return curve;
}

double single(const std::vector<Curve>& runs, Measure measure, std::size_t run) {
    const Comparison comparison = compare(runs, measure);
    REQUIRE(comparison.weights == Values{1.0});
    return comparison.values.at(run).at(0);
}

constexpr double kRounding = 1e-12;  // of sums of a few numbers near 1

}  // namespace

TEST_CASE("ProbeCurves.ComparesTheTimeInCommonAtAnySampleTimes") {
    // The same line sampled differently: no difference. Against one that is 3 higher: 3.
    const std::vector<Curve> runs{straight({0, 0.3, 1.1, 2}, 2), straight({0.1, 0.2, 1.9}, 2),
                                  straight({0, 1.5, 2.5}, 2, 3)};
    const Comparison comparison = compare(runs, Measure::curve);
    double sum = 0;
    for (const double weight : comparison.weights) sum += weight;
    CHECK(sum == Approx(1).margin(kRounding));
    CHECK(comparison.covered == Approx(1).margin(kRounding));
    CHECK(weighted_distance(comparison.values[0], comparison.values[1], comparison.weights) ==
          Approx(0).margin(kRounding));
    CHECK(weighted_distance(comparison.values[0], comparison.values[2], comparison.weights) ==
          Approx(3).margin(kRounding));
    // Squares of straight pieces are integrated exactly: rms of 2 t over [0.1, 1.9].
    const double rms = std::sqrt(4 * (std::pow(1.9, 3) - std::pow(0.1, 3)) / 3 / 1.8);
    CHECK(weighted_norm(comparison.values[0], comparison.weights) == Approx(rms).margin(kRounding));
    CHECK(single(runs, Measure::rms, 0) == Approx(rms).margin(kRounding));
    CHECK(single(runs, Measure::last, 0) == Approx(3.8).margin(kRounding));
    CHECK(single(runs, Measure::mean, 1) == Approx(2).margin(kRounding));
    CHECK(single(runs, Measure::min, 0) == Approx(0.2).margin(kRounding));
    CHECK(single(runs, Measure::max, 2) == Approx(6.8).margin(kRounding));
}

TEST_CASE("ProbeCurves.CrowdedSamplesDoNotCountMore") {
    // 0 for 9 s with two samples, then up to 1 within 1 s with many.
    Curve crowded{{0, 9}, {0.0, 0.0}};
    for (int k = 1; k <= 50; ++k) {
        crowded.time.push_back(9 + k / 50.0);
        crowded.value.emplace_back(k / 50.0);
    }
    CHECK(single({crowded, crowded}, Measure::mean, 0) == Approx(0.05).margin(kRounding));
}

TEST_CASE("ProbeCurves.TimesWithoutAValueAreLeftOut") {
    // One run is dry until t = 1 and cannot be told before its first value at t = 2.
    const Curve wet = straight({0, 1, 2, 3, 4}, 1);
    Curve dry = wet;
    dry.value[0] = dry.value[1] = std::nullopt;
    const std::vector<Curve> runs{wet, dry};
    const Comparison comparison = compare(runs, Measure::mean);
    CHECK(comparison.covered == Approx(0.5).margin(kRounding));
    CHECK(comparison.values[0] == comparison.values[1]);
    CHECK(comparison.values[0][0] == Approx(3).margin(kRounding));
    // No value at the end is no last value; no value at all compares nothing.
    dry.value[4] = std::nullopt;
    CHECK(compare(std::vector<Curve>{wet, dry}, Measure::last).values.empty());
    dry.value.assign(5, std::nullopt);
    CHECK(compare(std::vector<Curve>{wet, dry}, Measure::curve).values.empty());
}

TEST_CASE("ProbeCurves.OneInstantIsEnough") {
    const std::vector<Curve> runs{straight({0}, 0, 4), straight({0, 1}, 1, 5)};
    for (const Measure measure : {Measure::curve, Measure::last, Measure::rms}) {
        const Comparison comparison = compare(runs, measure);
        REQUIRE(comparison.values.size() == 2);
        CHECK(comparison.values[0] == Values{4});
        CHECK(comparison.values[1] == Values{5});
    }
    CHECK(compare(std::vector<Curve>{straight({0, 1}, 1), straight({2, 3}, 1)}, Measure::mean).values.empty());
    CHECK(compare(std::vector<Curve>{straight({0, 1}, 1), Curve{}}, Measure::mean).values.empty());
}

TEST_CASE("ProbeCurves.PointsOfAProfileWeighTheSame") {
    const Comparison low{{{1.0}, {2.0}}, {1.0}, 1.0}, high{{{3.0, 3.0}, {4.0, 6.0}}, {0.5, 0.5}, 0.5};
    const Comparison whole = combine(std::vector<Comparison>{low, {}, high});
    CHECK(whole.values[1] == Values{2, 4, 6});
    CHECK(whole.weights == Values{0.5, 0.25, 0.25});
    CHECK(whole.covered == Approx(0.5).margin(kRounding));
}
