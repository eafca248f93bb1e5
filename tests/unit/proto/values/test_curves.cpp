#include <catch2/catch.hpp>
#include <cmath>

#include "proto/values/curves.h"

using namespace headrace;
using scene::Curve;

namespace {

Curve curve(const std::string& text) {
    const auto made = scene::make_curve(proto::Scalar(text), 0.01, "here");
    if (!made) FAIL(made.error().message);
    return *made;
}

}  // namespace

TEST_CASE("Curve.DifferentiatesASineOfAnyPace") {
    // What curves.h promises, relative to the amplitudes omega and omega^2.
    const double omega = GENERATE(1.0, 6.28, 100.0, 6283.185307, 1e4);
    CAPTURE(omega);
    const Curve sine = curve("sin(" + std::to_string(omega) + "*t)");
    for (const double t : {0.0, 0.013, 0.7, 3.0}) {
        CAPTURE(t);
        const scene::CurvePoint point = sine.at(t);
        CHECK(point.value == Approx(std::sin(omega * t)).margin(1e-12));
        CHECK(point.rate == Approx(omega * std::cos(omega * t)).margin(1e-8 * omega));
        CHECK(point.acceleration == Approx(-omega * omega * std::sin(omega * t)).margin(1e-6 * omega * omega));
    }
}

TEST_CASE("Curve.IsNotFooledByAPeriodThatDividesItsSteps") {
    // Seen at multiples of 10 ms, 1 ms and 0.1 ms this stands still.
    const double omega = 2 * M_PI * 1e4;
    CHECK(curve("sin(2*pi*10000*t)").at(0.0).rate == Approx(omega).epsilon(1e-4));
}

TEST_CASE("Curve.DifferentiatesPolynomialsToRounding") {
    const Curve cubic = curve("2 - 3*t + 0.5*t^2 + t^3");
    const scene::CurvePoint point = cubic.at(0.4);
    CHECK(point.value == Approx(2 - 1.2 + 0.08 + 0.064));
    CHECK(point.rate == Approx(-3 + 0.4 + 3 * 0.16).margin(1e-11));
    CHECK(point.acceleration == Approx(1 + 6 * 0.4).margin(1e-9));
}

TEST_CASE("Curve.SeesOneSideOfAKink") {
    // A ramp that begins at t = 1: 1 ms away from it the smaller steps know one side only.
    const Curve ramp = curve("t < 1 ? 0 : 2*(t - 1)");
    CHECK(ramp.at(0.999).rate == Approx(0.0).margin(1e-9));
    CHECK(ramp.at(1.001).rate == Approx(2.0).margin(1e-8));
    CHECK(ramp.at(1.001).acceleration == Approx(0.0).margin(1e-3));
}

TEST_CASE("Curve.OfANumberStandsStill") {
    const auto number = scene::make_curve(proto::Scalar(1.5), 0.01, "here");
    CHECK(number->at(3.0).value == 1.5);
    CHECK(number->at(3.0).rate == 0.0);
    CHECK_FALSE(number->is_zero());
    CHECK(Curve().is_zero());
}

TEST_CASE("Curve.OfATableHasTheSplinesDerivatives") {
    const auto table = scene::make_curve(proto::TableDesc{{{0, 0}, {1, 2}, {2, 4}}}, 0.01, "here");
    CHECK(table->at(0.5).rate == Approx(2.0));
    CHECK(table->value(1.5) == Approx(3.0));
}

TEST_CASE("Curves.OfVectorsFollowTheDimensions") {
    const proto::TableDesc flat{{{0, 1, 2}, {1, 3, 4}}};
    const auto curves = scene::make_curves(flat, 2, 0.01, "here");
    REQUIRE(curves.ok());
    CHECK((*curves)[1].value(1.0) == 4.0);
    CHECK((*curves)[2].is_zero());
    CHECK(scene::make_curves(flat, 3, 0.01, "here").error().path == "here.table[0]");
    CHECK(
        scene::make_curves(proto::ScalarVec3{std::string("t"), std::string("x"), 0.0}, 2, 0.01, "here").error().path ==
        "here[1]");
}
