#include <catch2/catch.hpp>

#include "../plain_sums.h"
#include "server/solver/forces/shifting.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

TEST_CASE("Shifting.FactorByHand") {
    const Pair<2, double> pair{{1.0, 0.0}, 1.0, 1.0, 0.5};
    CHECK(shifting_factor<2, double>(pair, -3.0, 1.0) == Approx(0.5 * -3.0 * 1.2));
    CHECK(shifting_factor<2, double>(pair, -3.0, 0.0) == Approx(0.5 * -3.0));
    CHECK(shifting_factor<2, double>(pair, -3.0, 2.0) == Approx(0.5 * -3.0 * (1.0 + 0.2 * 16.0)));
}

TEST_CASE("Shifting.MovesFromDenseToThin") {
    // One neighbour nearer on the right: the shift -C U dt 2h sum points left; an even lattice has none.
    Cloud<2> cloud = make_cloud<2>(4, 0.0, 1);
    const std::size_t i = cloud.middle();
    const auto shift_of = [&] {
        std::array<double, 2> sum{};
        const WendlandC2<2> kernel = cloud.kernel();
        cloud.for_each_neighbour(i, [&](std::size_t, const Pair<2, double>& pair, double F) {
            add_to<2, double>(
                sum,
                scaled<2, double>(-shifting_factor<2, double>(pair, F, kernel.W(pair.r) / kernel.W(1.0)), pair.x_ij));
        });
        return sum;
    };
    CHECK(std::abs(shift_of()[0]) < 1e-15);
    for (auto& x : cloud.x) {
        if (x[0] == 1.0 && x[1] == 0.0) x[0] = 0.7;
    }
    CHECK(shift_of()[0] < -1e-3);
    CHECK(std::abs(shift_of()[1]) < 1e-15);
}

TEST_CASE("Shifting.IsLimitedTangentialAtSurfacesAndNoneInSpray") {
    ShiftingLimits limits;
    limits.longest = 0.1;
    const std::array<double, 2> normal{0.0, 3.0};
    CHECK(limit_shift<2>({0.02, -0.03}, 0.95, normal, limits) == std::array{0.02, -0.03});
    CHECK(limit_shift<2>({0.02, -0.03}, 0.7, normal, limits) == std::array{0.02, 0.0});
    CHECK(limit_shift<2>({0.02, -0.03}, 0.3, normal, limits) == std::array{0.0, 0.0});
    CHECK(limit_shift<2>({0.02, -0.03}, 0.7, {0.0, 0.0}, limits) == std::array{0.02, -0.03});
    const std::array<double, 2> cut = limit_shift<2>({3.0, -4.0}, 1.0, normal, limits);
    CHECK(cut[0] == Approx(0.06));
    CHECK(cut[1] == Approx(-0.08));
}

TEST_CASE("Shifting.IsNotNeededUnderPressure") {
    CHECK(shifting_need(50.0, 0.0) == Approx(1.0));
    CHECK(shifting_need(50.0, -1e5) == Approx(1.0));
    CHECK(shifting_need(50.0, 50.0) == Approx(0.5));
    CHECK(shifting_need(50.0, 1e6) < 1e-4);
    CHECK(shifting_need(0.0, 0.0) == 0.0);
}
