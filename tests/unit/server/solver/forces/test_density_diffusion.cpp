#include <catch2/catch.hpp>

#include "../plain_sums.h"
#include "server/solver/forces/density_diffusion.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

TEST_CASE("DensityDiffusion.OnePairByHand") {
    // 2 (delta_j - delta_i) x_ji/r^2 . F x_ij V_j = -2 (delta_j - delta_i) F V_j: flows to the thinner one.
    constexpr double V_j = 0.2, F = -5.0, delta_ij = -0.01;
    CHECK(plain_diffusion<double>(V_j * F, delta_ij, 0.0) == Approx(2.0 * 0.01 * 5.0 * 0.2));
    CHECK(plain_diffusion<double>(V_j * F, delta_ij, delta_ij) == 0.0);
    // Antuono: psi = 2 (delta_ji) x_ji/r^2 - sum_grad, dotted with F x_ij V_j.
    const double expected = (2.0 * 0.01 * -1.0 - (0.7 * 0.3 + 0.1 * -0.4)) * -5.0 * 0.2;
    CHECK(antuono_diffusion<2, double>(V_j * F, {0.3, -0.4}, delta_ij, {0.7, 0.1}) == Approx(expected));
}

TEST_CASE("DensityDiffusion.ConservesVolumePairByPair") {
    CHECK(plain_diffusion<double>(-5.0, 0.01, 0.002) == -plain_diffusion<double>(-5.0, -0.01, -0.002));
    CHECK(antuono_diffusion<2, double>(-5.0, {0.3, -0.4}, 0.01, {0.7, 0.1}) ==
          Approx(-antuono_diffusion<2, double>(-5.0, {-0.3, 0.4}, -0.01, {0.7, 0.1})));
}

TEST_CASE("DensityDiffusion.LeavesWhatItShouldAlone") {
    // On jittered particles a linear density is left alone by Antuono's form, still water by Fourtakas's; the plain
    // form disturbs both.
    const Cloud<2> cloud = make_cloud<2>(4, 0.25, 21);
    const std::size_t i = cloud.middle();
    const LinearField<2> delta{0.01, {2e-3, -5e-3}};
    double plain = 0.0, antuono = 0.0, fourtakas = 0.0, size = 0.0;
    cloud.for_each_neighbour(i, [&](std::size_t j, const Pair<2, double>& pair, double F) {
        const double V_F = pair.V_j * F, delta_ij = delta(cloud.x[i]) - delta(cloud.x[j]);
        plain += plain_diffusion<double>(V_F, delta_ij, 0.0);
        size += std::abs(plain_diffusion<double>(V_F, delta_ij, 0.0));
        antuono += antuono_diffusion<2, double>(V_F, pair.x_ij, delta_ij, {2.0 * delta.b[0], 2.0 * delta.b[1]});
        // hydrostatics: delta_H = g . x_ij/c0^2
        fourtakas += plain_diffusion<double>(V_F, delta_ij, dot<2, double>(delta.b, pair.x_ij));
    });
    CHECK(std::abs(plain) > 1e-3 * size);
    CHECK(std::abs(antuono) < 1e-13 * size);
    CHECK(std::abs(fourtakas) < 1e-13 * size);
}
