#include <catch2/catch.hpp>
#include <cmath>

#include "server/solver/integrator/step_limits.h"

using namespace headrace::solver;

TEST_CASE("StepLimit.SoftFluidIsLimitedBySound") {
    const StepLimit limit = find_step_limit({3, 0.0457, 3.0, 3.5, 0.02, 1.0});
    CHECK(limit.criterion == "acoustic");
    CHECK(limit.dt == Approx(0.4 * 0.0457 / (std::sqrt(3.0) + 1.0)));
}

TEST_CASE("StepLimit.RefinementMakesViscosityLimit") {
    // viscous ~ h^2, acoustic ~ h
    const auto limit = [](double h) {
        return find_step_limit({3, h, 3.0, 3.5, 0.02 * h * h * h / (0.0457 * 0.0457 * 0.0457), 0.0});
    };
    CHECK(limit(0.0457 / 20.0).criterion == "viscous");
    CHECK(limit(0.0457 / 40.0).dt == Approx(limit(0.0457 / 20.0).dt / 4.0));
}

TEST_CASE("StepLimit.ViscousLimitIsWhereALonePairTurnsUnstable") {
    // u = relative velocity; u_{n+1} = u_n - lambda dt (u_n + u_{n-1})/2 decays for lambda dt < 2, grows beyond
    const auto grows = [](double lambda_dt) {
        double before = 1.0, now = 0.9;
        for (int i = 0; i < 2000; ++i) {
            const double next = now - lambda_dt * 0.5 * (now + before);
            before = now;
            now = next;
        }
        return std::abs(now) + std::abs(before) > 1.0;
    };
    CHECK_FALSE(grows(1.98));
    CHECK(grows(2.02));
}
