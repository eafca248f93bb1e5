#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "client/richardson.h"

using namespace headrace::client;

namespace {

const Values kOne{1.0};  // the weight of a single number
// Results differ by 1e-2 to 1e-1 and carry errors of rounding of 1e-16: what follows from them is good to 1e-13 or so,
// and orders, whose formula has a bisection down to rounding, likewise.
constexpr double kRounding = 1e-11;

std::array<Values, 3> power_law(const std::array<double, 3>& spacings, double exact, double factor, double order) {
    std::array<Values, 3> values;
    for (std::size_t k = 0; k < 3; ++k) values[k] = {exact + factor * std::pow(spacings[k], order)};
    return values;
}

ResolutionEstimate estimate(double coarse, double middle, double fine) {
    return estimate_resolution({0.4, 0.2, 0.1}, {Values{coarse}, Values{middle}, Values{fine}}, kOne);
}

}  // namespace

TEST_CASE("Richardson.IsExactForPowerLaws") {
    const std::array<double, 3> equal{0.1, 0.1 / std::sqrt(2.0), 0.05}, unequal{0.1, 0.07, 0.04};
    for (const auto& spacings : {equal, unequal})
        for (const double order : {0.6, 1.0, 1.5, 2.0})
            for (const double factor : {3.0, -0.5}) {
                CAPTURE(order, factor, spacings[1]);
                const auto found = estimate_resolution(spacings, power_law(spacings, 7.0, factor, order), kOne);
                REQUIRE(found.convergence == Convergence::monotone);
                CHECK(*found.order == Approx(order).margin(kRounding));
                CHECK(found.extrapolated.at(0) == Approx(7.0).margin(kRounding));
                CHECK(found.error ==
                      Approx(1.25 * std::abs(factor) * std::pow(spacings[kFine], order)).margin(kRounding));
            }
}

TEST_CASE("Richardson.FindsTheOrderOfCurves") {
    // Each place converges with its own factor, the order is common; the weights differ.
    const std::array<double, 3> spacings{0.2, 0.15, 0.1};
    const Values weights{0.5, 0.2, 0.3}, exact{1.0, -2.0, 0.0}, factors{1.0, 3.0, -2.0};
    std::array<Values, 3> values;
    for (std::size_t run = 0; run < 3; ++run)
        for (std::size_t k = 0; k < 3; ++k) values[run].push_back(exact[k] + factors[k] * std::pow(spacings[run], 1.5));
    const auto found = estimate_resolution(spacings, values, weights);
    REQUIRE(found.convergence == Convergence::monotone);
    CHECK(*found.order == Approx(1.5).margin(kRounding));
    for (std::size_t k = 0; k < 3; ++k) CHECK(found.extrapolated.at(k) == Approx(exact[k]).margin(kRounding));
    CHECK(found.error == Approx(1.25 * weighted_norm(factors, weights) * std::pow(0.1, 1.5)).margin(kRounding));
}

TEST_CASE("Richardson.EqualResultsHaveNoErrorToTell") {
    for (const double value : {0.0, 3.0}) {
        const auto found = estimate(value, value, value);
        CHECK(found.convergence == Convergence::identical);
        CHECK(found.error == 0.0);
        CHECK_FALSE(found.order);
        CHECK(found.extrapolated.empty());
    }
    // Rounding is no difference.
    CHECK(estimate(1.0, 1.0 + 1e-14, 1.0).convergence == Convergence::identical);
}

TEST_CASE("Richardson.TheBarOfOscillatingResultsIsTheirSpread") {
    const auto found = estimate(1.0, 3.0, 2.5);
    CHECK(found.convergence == Convergence::oscillatory);
    CHECK_FALSE(found.order);
    CHECK(found.extrapolated.empty());
    CHECK(found.error == 2.0);
}

TEST_CASE("Richardson.ResultsThatDriftApartHaveNoOrder") {
    CHECK(estimate(1.0, 1.5, 3.0).convergence == Convergence::diverging);
    CHECK(estimate(1.0, 1.5, 3.0).error == 2.0);  // from the coarse to the fine run
    CHECK(estimate(1.0, 2.0, 3.0).convergence == Convergence::diverging);
    // A logarithm is the limit of order 0, whatever the ratios.
    const std::array<double, 3> spacings{0.3, 0.2, 0.1};
    std::array<Values, 3> values;
    for (std::size_t k = 0; k < 3; ++k) values[k] = {(1 + 1e-9 * double(k == 0)) * std::log(spacings[k])};
    CHECK(estimate_resolution(spacings, values, kOne).convergence == Convergence::diverging);
}

TEST_CASE("Richardson.AnOrderThatIsTooGoodDoesNotShrinkTheBar") {
    // Order 5: the bar is that of order 2 through the two coarser runs, 1.25 * 1 * 0.1^2/(0.4^2 - 0.2^2).
    const auto fast = estimate(1.0 + 1.0 / 32, 1.0 / 32, 0.0);
    REQUIRE(fast.convergence == Convergence::monotone);
    CHECK(*fast.order == Approx(5.0).margin(kRounding));
    CHECK(fast.order_used == 2.0);
    CHECK(fast.error == Approx(1.25 / 12).margin(kRounding));
    // The two finer runs agree by chance.
    const auto lucky = estimate(1.0, 0.0, 0.0);
    REQUIRE(lucky.convergence == Convergence::monotone);
    CHECK(lucky.error == Approx(1.25 / 12).margin(kRounding));
}

TEST_CASE("Richardson.HardlyConvergingResultsHaveAWiderBar") {
    const auto found = estimate_resolution({0.4, 0.2, 0.1}, power_law({0.4, 0.2, 0.1}, 0.0, 1.0, 0.1), kOne);
    REQUIRE(found.convergence == Convergence::monotone);
    CHECK(*found.order == Approx(0.1).margin(kRounding));
    CHECK(found.order_used == 0.5);
    const double difference = std::pow(0.2, 0.1) - std::pow(0.1, 0.1);
    CHECK(found.error == Approx(3 * difference / (std::sqrt(2.0) - 1)).margin(kRounding));
}

TEST_CASE("Richardson.UnrelatedCurvesDoNotConverge") {
    const unsigned seed = 20100;
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    constexpr std::size_t kPlaces = 1000;  // their correlation is -1/2 with a scatter of about 1/sqrt(1000)
    std::array<Values, 3> values;
    for (Values& run : values)
        for (std::size_t k = 0; k < kPlaces; ++k) run.push_back(uniform(random));
    const auto found = estimate_resolution({0.4, 0.2, 0.1}, values, Values(kPlaces, 1.0 / kPlaces));
    CHECK(found.convergence == Convergence::oscillatory);
}

TEST_CASE("Richardson.CompressibilityFollowsTheSquareOfTheMachNumber") {
    // f = 5 + 8/c^2 at c = 2 and c = 6: the error at c = 2 is 2.
    const double base = 5 + 8.0 / 4, faster = 5 + 8.0 / 36;
    CHECK(estimate_compressibility({base}, {faster}, kOne, 3.0) == Approx(1.25 * 2).margin(kRounding));
}
