#include "client/richardson.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace headrace::client {

namespace {

constexpr double kSafety = 1.25;         // Roache's factor where three runs show the order
constexpr double kPoorSafety = 3.0;      // his factor where they do not
constexpr double kLeastOrder = 0.5;      // below: hardly converging
constexpr double kMostOrder = 2.0;       // of a smoothing that is exact for linear fields
constexpr double kRounding = 1e-12;      // of the results: smaller differences are not of the method
constexpr double kSameDirection = 0.5;   // correlation of the two differences; unrelated noise in three runs gives -1/2
constexpr double kLargestSought = 50.0;  // orders past it are told as it

Values difference(const Values& a, const Values& b) {
    Values d(a.size());
    for (std::size_t k = 0; k < a.size(); ++k) d[k] = a[k] - b[k];
    return d;
}

double inner_product(const Values& a, const Values& b, const Values& weights) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += weights[k] * a[k] * b[k];
    return sum;
}

// (s3^p - s2^p)/(s2^p - s1^p), growing with p; its limit at p = 0.
double ratio_at(double p, double log_r32, double log_r21) {
    return p == 0 ? log_r32 / log_r21 : std::expm1(p * log_r32) / -std::expm1(-p * log_r21);
}

// The p at which the ratio is that of the differences; more than its value at 0.
double solve_order(double ratio, double log_r32, double log_r21) {
    double low = 0, high = kLargestSought;
    if (!(ratio < ratio_at(high, log_r32, log_r21))) return high;
    for (int turn = 0; turn < 100; ++turn) {  // halves the interval down to rounding
        const double p = 0.5 * (low + high);
        (ratio_at(p, log_r32, log_r21) < ratio ? low : high) = p;
    }
    return 0.5 * (low + high);
}

}  // namespace

double weighted_norm(const Values& values, const Values& weights) {
    return std::sqrt(inner_product(values, values, weights));
}

double weighted_distance(const Values& a, const Values& b, const Values& weights) {
    return weighted_norm(difference(a, b), weights);
}

ResolutionEstimate estimate_resolution(const std::array<double, 3>& spacings, const std::array<Values, 3>& values,
                                       const Values& weights) {
    const Values e32 = difference(values[kCoarse], values[kMiddle]), e21 = difference(values[kMiddle], values[kFine]);
    const double n32 = weighted_norm(e32, weights), n21 = weighted_norm(e21, weights);
    const double spread = std::max({n32, n21, weighted_distance(values[kCoarse], values[kFine], weights)});
    double scale = 0;
    for (const Values& run : values) scale = std::max(scale, weighted_norm(run, weights));

    ResolutionEstimate estimate;
    estimate.error = spread;
    if (spread <= kRounding * scale) return estimate;
    estimate.convergence = Convergence::oscillatory;
    if (inner_product(e32, e21, weights) < kSameDirection * n32 * n21) return estimate;
    const double log_r32 = std::log(spacings[kCoarse] / spacings[kMiddle]);
    const double log_r21 = std::log(spacings[kMiddle] / spacings[kFine]);
    estimate.convergence = Convergence::diverging;
    if (n32 <= n21 * ratio_at(0, log_r32, log_r21)) return estimate;

    estimate.convergence = Convergence::monotone;
    estimate.order = n21 > 0 ? solve_order(n32 / n21, log_r32, log_r21) : kLargestSought;
    const double p = estimate.order_used = std::clamp(*estimate.order, kLeastOrder, kMostOrder);
    // What is left at the finest spacing, as a multiple of either difference.
    const double of_e21 = 1 / std::expm1(p * log_r21);
    const double of_e32 = 1 / (std::exp(p * log_r21) * std::expm1(p * log_r32));
    estimate.extrapolated = values[kFine];
    for (std::size_t k = 0; k < e21.size(); ++k) estimate.extrapolated[k] -= of_e21 * e21[k];
    const double safety = *estimate.order < kLeastOrder ? kPoorSafety : kSafety;
    estimate.error = safety * std::max(n21 * of_e21, n32 * of_e32);
    return estimate;
}

double estimate_compressibility(const Values& base, const Values& faster, const Values& weights, double factor) {
    const double square = factor * factor;
    return kSafety * weighted_distance(base, faster, weights) * square / (square - 1);
}

}  // namespace headrace::client
