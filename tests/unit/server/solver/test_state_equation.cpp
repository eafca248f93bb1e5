#include <catch2/catch.hpp>

#include "server/solver/eos.h"

using namespace headrace::solver;

namespace {

constexpr double kRho0 = 998.0, kC0 = 35.0;

StateEquation equation(double gamma) {
    return {kRho0 * kC0 * kC0, gamma};
}

}  // namespace

TEST_CASE("StateEquation.DeviationIsTheInverseOfPressure") {
    const double gamma = GENERATE(1.0, 7.0);
    const StateEquation eos = equation(gamma);
    for (const double delta : {-0.03, -1e-9, 0.0, 1e-12, 1e-4, 0.05})
        CHECK(eos.deviation(eos.pressure(delta)) == Approx(delta).epsilon(1e-12).margin(1e-18));
    CHECK(eos.pressure(0.0) == 0.0);
    // Tait: B ((rho/rho0)^7 - 1) with B = rho0 c0^2/7
    if (gamma == 7.0) CHECK(eos.pressure(0.02) == Approx(eos.rho0_c2 / 7.0 * (std::pow(1.02, 7) - 1.0)));
}

TEST_CASE("StateEquation.InternalEnergyHasPressureAsDerivative") {
    const double gamma = GENERATE(1.0, 7.0);
    const StateEquation eos = equation(gamma);
    CHECK(std::abs(eos.internal_energy(0.0, kRho0)) < 1e-12);
    for (const double delta : {-0.03, 0.001, 0.05}) {
        // de/drho = p/rho^2; central difference, error O(step^2) = 1e-6.
        const double step = 1e-3 * std::abs(delta), rho = kRho0 * (1.0 + delta);
        const double slope = (eos.internal_energy(delta + step, kRho0) - eos.internal_energy(delta - step, kRho0)) /
                             (2.0 * step * kRho0);
        CHECK(slope == Approx(eos.pressure(delta) / (rho * rho)).epsilon(1e-5));
        CHECK(eos.internal_energy(delta, kRho0) > 0.0);
    }
}

TEST_CASE("StateEquation.SoundSpeedIsTheSlopeOfPressure") {
    const double gamma = GENERATE(1.0, 7.0);
    const StateEquation eos = equation(gamma);
    for (const double delta : {-0.02, 0.0, 0.04}) {
        const double step = 1e-5;
        const double c2 = (eos.pressure(delta + step) - eos.pressure(delta - step)) / (2.0 * step * kRho0);
        CHECK(kC0 * eos.relative_sound_speed(delta) == Approx(std::sqrt(c2)).epsilon(1e-7));
    }
}

TEST_CASE("StateEquation.HydrostaticPressureSolvesItsEquation") {
    const double gamma = GENERATE(1.0, 7.0);
    const StateEquation eos = equation(gamma);
    for (const double weight : {1.0, 1e3, 2e4}) {
        // dp/d(weight) = rho/rho0
        const double step = 1e-3 * weight;
        const double slope =
            (eos.hydrostatic_pressure(weight + step) - eos.hydrostatic_pressure(weight - step)) / (2.0 * step);
        CHECK(slope == Approx(1.0 + eos.deviation(eos.hydrostatic_pressure(weight))).epsilon(1e-8));
    }
    CHECK(eos.hydrostatic_pressure(0.0) == 0.0);
}
