#include <catch2/catch.hpp>

#include "../plain_sums.h"
#include "server/solver/forces/density_diffusion.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

Pair<2, double> make_pair(double x, double y, double V_j) {
    return {{x, y}, x * x + y * y, std::hypot(x, y), V_j};
}

}  // namespace

TEST_CASE("DensityDiffusion.OnePairByHand") {
    // 2 (delta_j - delta_i) x_ji/r^2 . F x_ij V_j = -2 (delta_j - delta_i) F V_j: flows to the thinner one.
    const Pair<2, double> pair = make_pair(0.3, -0.4, 0.2);
    CHECK(plain_diffusion<2, double>(pair, -5.0, 0.01, 0.0) == Approx(2.0 * 0.01 * 5.0 * 0.2));
    CHECK(plain_diffusion<2, double>(pair, -5.0, 0.01, 0.01) == 0.0);
    // Antuono: psi = 2 (delta_ji) x_ji/r^2 - sum_grad, dotted with F x_ij V_j.
    const double expected = (2.0 * 0.01 * -1.0 - (0.7 * 0.3 + 0.1 * -0.4)) * -5.0 * 0.2;
    CHECK(antuono_diffusion<2, double>(pair, -5.0, 0.01, {0.7, 0.1}) == Approx(expected));
}

TEST_CASE("DensityDiffusion.ConservesVolumePairByPair") {
    const Pair<2, double> pair = make_pair(0.3, -0.4, 1.0), back = make_pair(-0.3, 0.4, 1.0);
    CHECK(plain_diffusion<2, double>(pair, -5.0, 0.01, 0.002) ==
          -plain_diffusion<2, double>(back, -5.0, -0.01, -0.002));
    CHECK(antuono_diffusion<2, double>(pair, -5.0, 0.01, {0.7, 0.1}) ==
          Approx(-antuono_diffusion<2, double>(back, -5.0, -0.01, {0.7, 0.1})));
}

TEST_CASE("DensityDiffusion.LeavesWhatItShouldAlone") {
    // On jittered particles a linear density is left alone by Antuono's form, still water by Fourtakas's; the plain
    // form disturbs both.
    const Cloud<2> cloud = make_cloud<2>(4, 0.25, 21);
    const std::size_t i = cloud.middle();
    const LinearField<2> delta{0.01, {2e-3, -5e-3}};
    double plain = 0.0, antuono = 0.0, fourtakas = 0.0, size = 0.0;
    cloud.for_each_neighbour(i, [&](std::size_t j, const Pair<2, double>& pair, double F) {
        const double delta_ji = delta(cloud.x[j]) - delta(cloud.x[i]);
        plain += plain_diffusion<2, double>(pair, F, delta_ji, 0.0);
        size += std::abs(plain_diffusion<2, double>(pair, F, delta_ji, 0.0));
        antuono += antuono_diffusion<2, double>(pair, F, delta_ji, {2.0 * delta.b[0], 2.0 * delta.b[1]});
        // hydrostatics: delta^H = g . x_ji/c0^2
        fourtakas += plain_diffusion<2, double>(pair, F, delta_ji, -dot<2, double>(delta.b, pair.x_ij));
    });
    CHECK(std::abs(plain) > 1e-3 * size);
    CHECK(std::abs(antuono) < 1e-13 * size);
    CHECK(std::abs(fourtakas) < 1e-13 * size);
}
