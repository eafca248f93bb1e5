// The solid's share of a particle's sums, against the same integrals by brute force.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "server/solver/boundaries/integral_walls.h"
#include "server/solver/smoothing_kernels.h"

using namespace headrace::solver;

namespace {

constexpr double kR = 0.25;          // [m]
constexpr double kFine = kR / 48.0;  // layers so thin that their sum is the integral

SectionKernel kernel_of(int dimensions, KernelKind kind = KernelKind::wendland_c2) {
    SectionKernel kernel;
    kernel.dimensions = dimensions;
    kernel.support = kR;
    const AnyKernel<2> flat(kind, kR);
    const AnyKernel<3> solid(kind, kR);
    const bool is_flat = dimensions == 2;
    kernel.W = [=](double r) { return is_flat ? flat.W(r) : solid.W(r); };
    kernel.F = [=](double r) { return is_flat ? flat.F(r) : solid.F(r); };
    kernel.F_shifted = [=](double r) { return (is_flat ? flat.F(r) : solid.F(r)) * (1.0 + r / kR); };
    return kernel;
}

template <int D>
struct Integrals {
    std::array<double, D> grad{}, shifted{};
    Symmetric<D> M, viscous;
    double gamma{};
};

// Midpoint rule over the cells of a lattice that the solid's faces are part of: error (step/R)^2, 0.1 %. Round solids
// cut cells: 1 %. depth(x'): below the surface [m], negative in the fluid.
template <int D>
Integrals<D> integrate(const SectionKernel& kernel, const std::array<double, D>& x, const Vec3& anchor, double d,
                       const std::function<double(const Vec3&)>& depth) {
    const double step = kR / 40.0;
    Integrals<D> sum;
    const double volume = std::pow(step, D);
    std::array<int, 3> first{}, last{1, 1, 1};
    for (int k = 0; k < D; ++k) {
        first[k] = static_cast<int>(std::floor((x[k] - kR - anchor[k]) / step));
        last[k] = static_cast<int>(std::ceil((x[k] + kR - anchor[k]) / step));
    }
    for (int i = first[0]; i < last[0]; ++i) {
        for (int j = first[1]; j < last[1]; ++j) {
            for (int k = first[2]; k < last[2]; ++k) {
                const std::array<int, 3> cell{i, j, k};
                Vec3 there{};
                std::array<double, D> y;
                for (int axis = 0; axis < D; ++axis) {
                    there[axis] = anchor[axis] + (cell[axis] + 0.5) * step;
                    y[axis] = there[axis] - x[axis];
                }
                const double r2 = dot<D, double>(y, y), r = std::sqrt(r2), below = depth(there);
                if (r >= kR || below < 0.0) continue;
                const double F = kernel.F(r) * volume;
                for (int a = 0; a < D; ++a) {
                    sum.grad[a] -= F * y[a];
                    sum.shifted[a] -= kernel.F_shifted(r) * volume * y[a];
                    for (int b = a; b < D; ++b) {
                        sum.M(a, b) -= F * y[a] * y[b];
                        sum.viscous(a, b) += F * y[a] * y[b] / r2 * (1.0 + below / d);
                    }
                }
                sum.gamma += kernel.W(r) * volume;
            }
        }
    }
    return sum;
}

template <int D>
WallShare<D> share_of(const IntegralWalls& walls, const std::array<double, D>& x) {
    WallShare<D> share;
    walls.find_share<D>(x, 1e-3 * kR, share);
    return share;
}

// tolerance: of the size that each integral has for half a support.
template <int D>
void check_equal(const WallShare<D>& share, const Integrals<D>& expected, double tolerance) {
    for (int k = 0; k < D; ++k) {
        INFO("axis " << k);
        CHECK(std::abs(share.grad[k] - expected.grad[k]) < tolerance / kR);
        CHECK(std::abs(share.shifted[k] - expected.shifted[k]) < tolerance / kR);
        double parts = 0.0;
        for (int p = 0; p < share.count; ++p) parts += share.part[p].grad[k];
        CHECK(std::abs(parts - share.grad[k]) < 1e-12 / kR);
    }
    for (int k = 0; k < Symmetric<D>::kSize; ++k) {
        INFO("component " << k);
        CHECK(std::abs(share.M[k] - expected.M.e[k]) < tolerance);
    }
    double gamma = 0.0;
    for (int p = 0; p < share.count; ++p) gamma += share.part[p].gamma;
    CHECK(std::abs(gamma - expected.gamma) < tolerance);
}

template <int D>
Symmetric<D> sum_of_viscous(const WallShare<D>& share) {
    Symmetric<D> sum;
    for (int p = 0; p < share.count; ++p) {
        for (int k = 0; k < Symmetric<D>::kSize; ++k) sum.e[k] += share.part[p].viscous[k];
    }
    return sum;
}

// A room from the origin to (1, 1, 1).
template <int D>
IntegralWalls make_room(const SectionKernel& kernel, double layer = kFine) {
    IntegralWalls walls(kernel, layer);
    for (int k = 0; k < D; ++k) {
        walls.add_face(k, 0, 0.0, {});
        walls.add_face(k, 1, 1.0, {});
    }
    return walls;
}

template <int D>
double depth_in_room(const Vec3& x) {
    double below = -1.0;
    for (int k = 0; k < D; ++k) below = std::max({below, -x[k], x[k] - 1.0});
    return below;
}

template <int D>
void check_room() {
    for (const KernelKind kind : {KernelKind::wendland_c2, KernelKind::quintic_spline}) {
        const SectionKernel kernel = kernel_of(D, kind);
        const IntegralWalls walls = make_room<D>(kernel);
        // Distances from the three faces that meet at the origin: one in reach, two, three; sunk in a little.
        for (const Vec3& from : {Vec3{0.1, 0.5, 0.5}, Vec3{0.02, 0.5, 0.5}, Vec3{0.05, 0.12, 0.5}, Vec3{0.5, 0.2, 0.04},
                                 Vec3{0.05, 0.1, 0.07}, Vec3{0.2, 0.01, 0.03}, Vec3{0.06, -0.004, 0.02}}) {
            INFO(D << "D, kernel " << static_cast<int>(kind) << ", at " << from[0] << ' ' << from[1] << ' ' << from[2]);
            std::array<double, D> x;
            for (int k = 0; k < D; ++k) x[k] = from[k];
            check_equal<D>(share_of<D>(walls, x), integrate<D>(kernel, x, {}, 1.0, depth_in_room<D>), 4e-3);
        }
        CHECK(walls.is_near<D>(std::array<double, D>{0.5, 0.24}));
    }
}

}  // namespace

TEST_CASE("IntegralWalls.RoomsAreTheIntegralsOverTheirSolid") {
    check_room<2>();
    check_room<3>();
}

TEST_CASE("IntegralWalls.NoneIsNearInTheMiddleOfARoom") {
    const IntegralWalls walls = make_room<2>(kernel_of(2));
    CHECK_FALSE(walls.is_near<2>({0.5, 0.26}));
    CHECK(walls.is_near<2>({0.5, 0.76}));
    CHECK(share_of<2>(walls, {0.5, 0.5}).count == 0);
}

namespace {

template <int D>
void check_box() {
    const SectionKernel kernel = kernel_of(D);
    IntegralWalls walls(kernel, kFine);
    walls.add_box({{0, 0, 0}, {1, 1, 1}, {}, {}});
    const auto depth = [](const Vec3& x) {
        double below = 1.0;
        for (int k = 0; k < D; ++k) below = std::min({below, x[k], 1.0 - x[k]});
        return below;
    };
    // Before a face, near its rim, near its corner, before an edge, before a corner.
    for (const Vec3& at : {Vec3{-0.05, 0.5, 0.5}, Vec3{-0.05, 0.1, 0.5}, Vec3{-0.1, 0.08, 0.9}, Vec3{-0.05, -0.1, 0.5},
                           Vec3{-0.06, -0.04, 0.1}, Vec3{-0.05, -0.08, -0.1}, Vec3{0.004, 0.5, 0.5}}) {
        INFO(D << "D, at " << at[0] << ' ' << at[1] << ' ' << at[2]);
        std::array<double, D> x;
        for (int k = 0; k < D; ++k) x[k] = at[k];
        check_equal<D>(share_of<D>(walls, x), integrate<D>(kernel, x, {}, 1.0, depth), 4e-3);
    }
}

template <int D>
void check_sphere(bool is_container) {
    const SectionKernel kernel = kernel_of(D);
    IntegralWalls walls(kernel, kFine);
    walls.add_sphere({}, 0.5, is_container, {});
    const auto depth = [&](const Vec3& x) {
        const double below = 0.5 - std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        return is_container ? -below : below;
    };
    for (const double d : {0.01, 0.05, 0.13, 0.22}) {
        INFO(D << "D, " << (is_container ? "inside" : "outside") << ", distance " << d);
        const double r = is_container ? 0.5 - d : 0.5 + d;
        std::array<double, D> x{0.6 * r, 0.8 * r};
        const WallShare<D> share = share_of<D>(walls, x);
        const Integrals<D> expected = integrate<D>(kernel, x, {}, d, depth);
        check_equal<D>(share, expected, 1.2e-2);
        const Symmetric<D> viscous = sum_of_viscous<D>(share);
        for (int k = 0; k < Symmetric<D>::kSize; ++k)
            CHECK(std::abs(viscous.e[k] - expected.viscous.e[k]) < 2e-2 / (kR * kR) * (1.0 + 0.3 * kR / d));
    }
}

}  // namespace

TEST_CASE("IntegralWalls.BoxesAreTheIntegralsOverTheirInside") {
    check_box<2>();
    check_box<3>();
}

TEST_CASE("IntegralWalls.SpheresAreTheIntegralsOverTheirSolid") {
    for (const bool is_container : {false, true}) {
        check_sphere<2>(is_container);
        check_sphere<3>(is_container);
    }
}

TEST_CASE("IntegralWalls.ViscousShareOfAFlatWallGrowsWithTheDepth") {
    const SectionKernel kernel = kernel_of(3);
    const IntegralWalls walls = make_room<3>(kernel);
    for (const double d : {0.03, 0.1, 0.2}) {
        const std::array<double, 3> x{d, 0.5, 0.5};
        const Symmetric<3> viscous = sum_of_viscous<3>(share_of<3>(walls, x));
        const Integrals<3> expected = integrate<3>(kernel, x, {}, d, depth_in_room<3>);
        for (int k = 0; k < Symmetric<3>::kSize; ++k)
            CHECK(std::abs(viscous.e[k] - expected.viscous.e[k]) < 1e-2 / (kR * kR) * (1.0 + 0.3 * kR / d));
    }
}
