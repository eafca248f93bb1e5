#include <catch2/catch.hpp>

#include "../plain_sums.h"
#include "server/solver/forces/continuity.h"
#include "server/solver/forces/gradient_correction.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

template <int D>
Symmetric<D> moment_of(const Cloud<D>& cloud, std::size_t i) {
    Symmetric<D> M;
    cloud.for_each_neighbour(
        i, [&](std::size_t, const Pair<D, double>& pair, double F) { accumulate_moment<D, double>(pair, F, M); });
    return M;
}

template <int D>
void check_linear_velocity() {
    const Cloud<D> cloud = make_cloud<D>(4, 0.2, 5);
    const std::size_t i = cloud.middle();
    const Symmetric<D> B = inverse(moment_of(cloud, i));
    // v_k = sum_l G_kl x_l with a divergence of 1.5 + D
    const auto velocity = [](const std::array<double, D>& x) {
        std::array<double, D> v{};
        for (int k = 0; k < D; ++k) {
            for (int l = 0; l < D; ++l) v[k] += (k == l ? 1.0 : 0.7 * k - 0.3 * l) * x[l];
        }
        v[0] += 1.5 * x[0] + 4.0;
        return v;
    };
    double divergence = 0.0;
    const auto v_i = velocity(cloud.x[i]);
    cloud.for_each_neighbour(i, [&](std::size_t j, const Pair<D, double>& pair, double F) {
        std::array<double, D> v_ij = velocity(cloud.x[j]);
        for (int k = 0; k < D; ++k) v_ij[k] = v_i[k] - v_ij[k];
        divergence += velocity_divergence<D, double>(pair.V_j * F, B * pair.x_ij, v_ij);
    });
    CHECK(divergence == Approx(D + 1.5).epsilon(1e-12));
}

}  // namespace

TEST_CASE("Continuity.DivergenceOfALinearVelocityIsExact") {
    check_linear_velocity<2>();
    check_linear_velocity<3>();
}

TEST_CASE("Continuity.OnePairByHand") {
    // (v_j - v_i) . grad W V_j: approaching particles, grad_i W = F x_ij with F < 0.
    const double V_j = 0.5, F = -3.0;
    CHECK(velocity_divergence<2, double>(V_j * F, {2.0, 0.0}, {-1.0, 9.0}) == Approx(0.5 * -3.0 * 2.0));
    CHECK(velocity_divergence<2, double>(V_j * F, {2.0, 0.0}, {0.0, 0.0}) == 0.0);
}

TEST_CASE("GradientCorrection.MomentOfAFullLatticeIsNearOneAndOneSidedIsNot") {
    Cloud<2> full = make_cloud<2>(4, 0.0, 1);
    const Symmetric<2> M = moment_of(full, full.middle());
    // accuracy notes: first-moment error of Wendland C2 at R = 3 dx is -0.3 %
    CHECK(M(0, 0) == Approx(0.997).margin(0.001));
    CHECK(M(0, 1) == Approx(0.0).margin(1e-14));
    CHECK(smallest_eigenvalue(M) == Approx(M(0, 0)).epsilon(1e-12));

    Cloud<2> half = full;
    half.x.clear();
    for (const auto& x : full.x) {
        if (x[1] < 0.5) half.x.push_back(x);
    }
    half.V.assign(half.x.size(), 1.0);
    const Symmetric<2> one_sided = moment_of(half, half.middle());
    // The row of its own gives nothing across, the others half: 1/2 across the surface.
    CHECK(smallest_eigenvalue(one_sided) == Approx(0.5).margin(0.01));
    CHECK(correction_matrix<2>(one_sided, 0.5, 0.9).e == Symmetric<2>::identity().e);
    CHECK(correction_matrix<2>(one_sided, 0.5, 0.3)(1, 1) == Approx(1.0 / 0.5).margin(0.05));
    CHECK(correction_matrix<2>(M, 0.9, 0.9)(0, 0) == Approx(1.0 / M(0, 0)));
}

TEST_CASE("GradientCorrection.GradientOfALinearFieldIsExactAtASurface") {
    Cloud<3> cloud = make_cloud<3>(4, 0.2, 9);
    Cloud<3> half;
    half.R = cloud.R;
    for (std::size_t j = 0; j < cloud.x.size(); ++j) {
        if (cloud.x[j][2] > 0.5) continue;
        half.x.push_back(cloud.x[j]);
        half.V.push_back(cloud.V[j]);
    }
    const std::size_t i = half.middle();
    const Symmetric<3> B = inverse(moment_of(half, i));
    const LinearField<3> field{2.0, {0.5, -1.0, 3.0}};
    std::array<double, 3> sum{};
    half.for_each_neighbour(i, [&](std::size_t j, const Pair<3, double>& pair, double F) {
        add_to<3, double>(sum, scaled<3, double>(pair.V_j * F * (field(half.x[j]) - field(half.x[i])), pair.x_ij));
    });
    const std::array<double, 3> gradient = B * sum;
    for (int k = 0; k < 3; ++k) CHECK(gradient[k] == Approx(field.b[k]).epsilon(1e-11));
}
