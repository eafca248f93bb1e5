#include <catch2/catch.hpp>
#include <numbers>

#include "server/solver/smoothing_kernels.h"

using namespace headrace::solver;

namespace {

constexpr double kR = 0.37;  // [m]
constexpr KernelKind kAll[] = {KernelKind::wendland_c2, KernelKind::wendland_c4, KernelKind::cubic_spline,
                               KernelKind::quintic_spline};

template <int D>
double integral(const AnyKernel<D>& kernel) {
    // Midpoint rule: error O(step^2) = 1e-8 of a smooth integrand.
    constexpr int kSlices = 20000;
    const double step = kR / kSlices;
    double sum = 0.0;
    for (int k = 0; k < kSlices; ++k) {
        const double r = (k + 0.5) * step;
        const double shell = D == 2 ? 2.0 * std::numbers::pi * r : 4.0 * std::numbers::pi * r * r;
        sum += shell * kernel.W(r) * step;
    }
    return sum;
}

template <int D>
void check_kernels() {
    for (const KernelKind kind : kAll) {
        INFO(D << "D, kernel " << static_cast<int>(kind));
        const AnyKernel<D> kernel(kind, kR);
        CHECK(integral(kernel) == Approx(1.0).epsilon(1e-7));
        const double scale = kernel.W(0.0);
        for (double r = 0.02 * kR; r < 0.999 * kR; r += 0.017 * kR) {
            // Central differences: error O(step^2) = 1e-8 of W''' R^3, some hundred W(0).
            const double step = 1e-4 * kR;
            const double slope = (kernel.W(r + step) - kernel.W(r - step)) / (2.0 * step);
            CHECK(std::abs(kernel.F(r) * r - slope) < 1e-5 * scale / kR);
            const double change = (kernel.F(r + step) - kernel.F(r - step)) / (2.0 * step);
            CHECK(std::abs(kernel.dF_dr(r) - change) < 2e-3 * scale / (kR * kR * kR));
            CHECK(kernel.F(r) <= 0.0);
            CHECK(kernel.W(r) > 0.0);
        }
        for (const double r : {kR, 1.1 * kR, 50.0 * kR}) {
            CHECK(std::abs(kernel.W(r)) < 1e-14 * scale);  // 0 but for r/R above 1 by rounding
            CHECK(std::abs(kernel.F(r)) < 1e-14 * scale / (kR * kR));
        }
        CHECK(std::isfinite(kernel.F(0.0)));
    }
}

}  // namespace

TEST_CASE("SmoothingKernels.IntegrateToOneAndKnowTheirSlopes") {
    check_kernels<2>();
    check_kernels<3>();
}

TEST_CASE("SmoothingKernels.AnyKernelsWendlandIsTheFastOne") {
    const AnyKernel<2> any_2(KernelKind::wendland_c2, kR);
    const AnyKernel<3> any_3(KernelKind::wendland_c2, kR);
    const WendlandC2<2> fast_2(kR);
    const WendlandC2<3> fast_3(kR);
    for (double r = 0.0; r < 1.2 * kR; r += 0.013 * kR) {
        CHECK(any_2.W(r) == fast_2.W(r));
        CHECK(any_2.F(r) == fast_2.F(r));
        CHECK(any_2.dF_dr(r) == fast_2.dF_dr(r));
        CHECK(any_3.W(r) == fast_3.W(r));
        CHECK(any_3.F(r) == fast_3.F(r));
        CHECK(any_3.dF_dr(r) == fast_3.dF_dr(r));
    }
}

TEST_CASE("SmoothingKernels.WendlandC2IsWeightedByBothVolumes") {
    const WendlandC2<2> kernel_2(kR);
    const WendlandC2<3> kernel_3(kR);
    for (double r = 0.0; r < 1.2 * kR; r += 0.013 * kR) {
        // Approx is wide beside the rounding of four products.
        CHECK(kernel_2.weighted_F(r, 0.3, 1.7) == Approx(0.3 * 1.7 * kernel_2.F(r)));
        CHECK(kernel_3.weighted_F(r, 0.3, 1.7) == Approx(0.3 * 1.7 * kernel_3.F(r)));
    }
}

TEST_CASE("SmoothingKernels.WendlandC2HasItsTabulatedValues") {
    // (1-s)^4 (1+4s) at s = 1/2 is 3/16; N = 7/(pi R^2), 21/(2 pi R^3).
    CHECK(WendlandC2<2>(2.0).W(1.0) == Approx(7.0 / (4.0 * std::numbers::pi) * 3.0 / 16.0));
    CHECK(WendlandC2<3>(2.0).W(1.0) == Approx(21.0 / (16.0 * std::numbers::pi) * 3.0 / 16.0));
}
