// Each kind of probe on a fluid whose answer is known.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/server/probes/fixtures.h"

using namespace headrace;
using namespace headrace::test;

namespace {

constexpr double kDx = 0.02;  // [m]
const StillModel kModel(3.0 * kDx);

double hydrostatic(const Vec3& x) {
    return 9810.0 * (0.5 - x[1]);
}

}  // namespace

TEST_CASE("PressureProbe.IsExactForPressureThatIsLinearInDepth") {
    auto fluid = make_box(2, kDx, {0, 0, 0}, {1, 0.5, 0}, 0.2);
    set_field(fluid, fluid.p, hydrostatic);
    const Scene scene{fluid, kModel, kDx};
    // On the floor, on a side, inside. 9810 Pa at most, so rounding stays below 1e-8 Pa.
    CHECK(*scene.measure(proto::PressureProbe{{0.5, 0, 0}})[0] == Approx(4905.0).margin(1e-7));
    CHECK(*scene.measure(proto::PressureProbe{{1, 0.2, 0}})[0] == Approx(9810.0 * 0.3).margin(1e-7));
    CHECK(*scene.measure(proto::PressureProbe{{0.3, 0.3, 0}})[0] == Approx(9810.0 * 0.2).margin(1e-7));
    // No fluid in reach: no value.
    CHECK_FALSE(scene.measure(proto::PressureProbe{{0.5, 0.8, 0}})[0].has_value());
}

TEST_CASE("PressureProbe.APatchGivesTheMeanAndDryPartsCountAsZero") {
    auto flat = make_box(2, kDx, {0, 0, 0}, {1, 0.5, 0});
    set_field(flat, flat.p, hydrostatic);
    const Scene scene{flat, kModel, kDx};
    // The mean of a linear field over a patch is its value in the middle.
    CHECK(*scene.measure(proto::PressureProbe{{1, 0.2, 0}, 0.05, {-2, 0, 0}})[0] == Approx(9810.0 * 0.3).margin(1e-7));
    CHECK(*scene.measure(proto::PressureProbe{{0.5, 0.5, 0}, 0.05, {0, 1, 0}})[0] == Approx(0.0).margin(1e-7));
    CHECK(*scene.measure(proto::PressureProbe{{0.5, 0.9, 0}, 0.05, {1, 0, 0}})[0] == 0.0);

    auto deep = make_box(3, 0.05, {0, 0, 0}, {1, 0.5, 1});
    set_field(deep, deep.p, [](const Vec3&) { return 700.0; });
    const StillModel model(0.15);
    const Scene tank{deep, model, 0.05};
    CHECK(*tank.measure(proto::PressureProbe{{1, 0.2, 0.5}, 0.1, {1, 0, 0}})[0] == Approx(700.0));
    // The upper half of a large patch is dry but for what the support reaches over the surface.
    const double half = *tank.measure(proto::PressureProbe{{1, 0.5, 0.5}, 0.4, {1, 0, 0}})[0];
    CHECK(half > 0.5 * 700.0);
    CHECK(half < 0.8 * 700.0);
}

TEST_CASE("VelocityProbe.GivesTheComponents") {
    auto fluid = make_box(3, 0.05, {0, 0, 0}, {0.5, 0.5, 0.5}, 0.2);
    set_field(fluid, fluid.v[0], [](const Vec3& x) { return 1.0 + x[1]; });
    set_field(fluid, fluid.v[1], [](const Vec3& x) { return -2.0 * x[2]; });
    set_field(fluid, fluid.v[2], [](const Vec3&) { return 0.25; });
    const StillModel model(0.15);
    const auto v = Scene{fluid, model, 0.05}.measure(proto::VelocityProbe{{0.2, 0.3, 0.1}});
    REQUIRE(v.size() == 3);
    CHECK(*v[0] == Approx(1.3));
    CHECK(*v[1] == Approx(-0.2));
    CHECK(*v[2] == Approx(0.25));
}

TEST_CASE("ProfileProbe.GivesEquidistantPointsWithTheirPositions") {
    auto fluid = make_box(2, kDx, {0, 0, 0}, {1, 0.5, 0});
    set_field(fluid, fluid.v[0], [](const Vec3& x) { return 4.0 * x[1]; });
    const proto::ProfileProbe desc{{0.5, 0, 0}, {0.5, 0.5, 0}, 6, proto::ProfileField::velocity_x};
    const auto values = Scene{fluid, kModel, kDx}.measure(desc);
    REQUIRE(values.size() == 6);
    for (int k = 0; k < 6; ++k) CHECK(*values[k] == Approx(0.4 * k).margin(1e-12));
    const auto columns = probes::make_probe(desc, 2)->columns();
    CHECK(columns[3].name == "vx_3");
    CHECK(columns[3].unit == "m/s");
    CHECK(*columns[3].position == Approx(0.3));
}

// The concentration of a lattice below a flat surface is 1/2 on the surface up to the error of the sum over the
// lattice, below 2 % for these supports; its slope there is about 1.5/R, so the level is right to 2 % * R / 1.5, less
// than a twentieth of a spacing.
TEST_CASE("LevelProbe.FindsTheSurfaceOfAHalfFilledBox") {
    const double support = GENERATE(2.4, 3.0, 4.0);
    const int dimensions = GENERATE(2, 3);
    INFO("support " << support << " spacings, " << dimensions << " dimensions");
    const StillModel model(support * kDx);
    const auto fluid = make_box(dimensions, kDx, {0, 0, 0}, {0.3, 0.2, 0.3});
    Scene scene{fluid, model, kDx};
    scene.objects.push_back(box_object("tank", solver::Role::container, {0, 0, 0}, {0.3, 0.4, 0.3}));
    const double tolerance = 0.05 * kDx;
    // In the middle; a line need not start on the floor.
    CHECK(*scene.measure(proto::LevelProbe{{0.15, 0, 0.15}, {0.15, 0.4, 0.15}})[0] == Approx(0.2).margin(tolerance));
    CHECK(*scene.measure(proto::LevelProbe{{0.15, 0.1, 0.15}, {0.15, 0.4, 0.15}})[0] == Approx(0.1).margin(tolerance));
    // On a wall and in a corner, where a half or more of the support lies outside the tank. The share of the support
    // that is open is known to a few per cent only: a fifth of a spacing.
    CHECK(*scene.measure(proto::LevelProbe{{0, 0, 0.15}, {0, 0.4, 0.15}})[0] == Approx(0.2).margin(0.2 * kDx));
    CHECK(*scene.measure(proto::LevelProbe{{0, 0, 0}, {0, 0.4, 0}})[0] == Approx(0.2).margin(0.2 * kDx));
    // Horizontally the fluid reaches past the end.
    CHECK(*scene.measure(proto::LevelProbe{{0.1, 0.1, 0.15}, {0.2, 0.1, 0.15}})[0] == Approx(0.1));
}

TEST_CASE("LevelProbe.TakesTheHighestOrLowestSurfaceAndOverlooksDropsAndDryLines") {
    const auto is_layer = [](const Vec3& x) { return x[1] < 0.1 || (x[1] > 0.2 && x[1] < 0.3); };
    const auto layers = make_fluid(2, kDx, {0, 0, 0}, {0.3, 0.4, 0}, is_layer);
    const proto::LevelProbe line{{0.15, 0, 0}, {0.15, 0.4, 0}};
    CHECK(*Scene{layers, kModel, kDx}.measure(line)[0] == Approx(0.3).margin(0.05 * kDx));
    proto::LevelProbe lowest = line;
    lowest.surface = proto::LevelSurface::lowest;
    CHECK(*Scene{layers, kModel, kDx}.measure(lowest)[0] == Approx(0.1).margin(0.05 * kDx));
    lowest.from[1] = 0.15;  // dry
    CHECK(*Scene{layers, kModel, kDx}.measure(lowest)[0] == 0.0);
    lowest.from[1] = 0.05, lowest.to[1] = 0.08;  // wet all the way
    CHECK(*Scene{layers, kModel, kDx}.measure(lowest)[0] == Approx(0.03));

    const auto is_drop = [](const Vec3& x) {
        return x[1] < 0.1 || (x[1] > 0.3 && x[1] < 0.32 && x[0] > 0.14 && x[0] < 0.16);
    };
    const auto drop = make_fluid(2, kDx, {0, 0, 0}, {0.3, 0.4, 0}, is_drop);
    REQUIRE(drop.size() > 75);
    CHECK(*Scene{drop, kModel, kDx}.measure(line)[0] == Approx(0.1).margin(0.05 * kDx));

    CHECK(*Scene{drop, kModel, kDx}.measure(proto::LevelProbe{{3, 0, 0}, {3, 1, 0}})[0] == 0.0);
}

TEST_CASE("FrontProbe.IsTheEdgeOfTheFurthestParticle") {
    const auto fluid = make_box(2, kDx, {0, 0, 0}, {0.6, 0.3, 0});
    const Scene scene{fluid, kModel, kDx};
    CHECK(*scene.measure(proto::FrontProbe{{1, 0, 0}})[0] == Approx(0.6));
    CHECK(*scene.measure(proto::FrontProbe{{-5, 0, 0}})[0] == Approx(0.0).margin(1e-12));
    CHECK(*scene.measure(proto::FrontProbe{{0, 2, 0}})[0] == Approx(0.3));
}

// The sum of a kernel in one dimension over a lattice of a third of its support is 1 to 0.5 %: the Wendland kernel's
// Fourier transform at the lattice's wave number is what is left.
TEST_CASE("DischargeProbe.OfUniformFlowIsVelocityTimesSection") {
    auto flat = make_box(2, kDx, {0, 0, 0}, {1, 0.5, 0});
    set_field(flat, flat.v[0], [](const Vec3&) { return 2.0; });
    set_field(flat, flat.v[1], [](const Vec3&) { return 5.0; });
    Scene scene{flat, kModel, kDx};
    for (const double place : {0.5, 0.503, 0.507, 0.51}) {
        CHECK(*scene.measure(proto::DischargeProbe{{place, 0, 0}, {3, 0, 0}})[0] == Approx(1.0).epsilon(0.005));
        CHECK(*scene.measure(proto::DischargeProbe{{place, 0, 0}, {-1, 0, 0}})[0] == Approx(-1.0).epsilon(0.005));
    }
    // At the end of a periodic channel both halves of the kernel find fluid.
    scene.domain = {{0, 0, 0}, {1, 1, 0}, {true, false, false}};
    CHECK(*scene.measure(proto::DischargeProbe{{0, 0, 0}, {1, 0, 0}})[0] == Approx(1.0).epsilon(0.005));
    CHECK(
        probes::make_probe(proto::ProbeDesc{"q", proto::DischargeProbe{{}, {1, 0, 0}}, {}, {}}, 2)->columns()[0].unit ==
        "m^2/s");
}

TEST_CASE("DensityProbe.GivesMeanLargestErrorAndVolume") {
    auto fluid = make_box(2, 0.1, {0, 0, 0}, {1, 1, 0});
    fluid.rho[7] = 1.1 * kRestDensity;
    const auto values = Scene{fluid, kModel, 0.1}.measure(proto::DensityProbe{});
    CHECK(*values[0] == Approx(0.1 / 100));
    CHECK(*values[1] == Approx(0.1));
    CHECK(*values[2] == Approx(0.99 + 0.01 / 1.1));
}

TEST_CASE("ForceProbe.TakesTheTorqueAboutItsPoint") {
    const auto fluid = make_box(3, 0.1, {0, 0, 0}, {0.5, 0.5, 0.5});
    StillModel model(0.3);
    model.loads = {{{9, 9, 9}, {}}, {{0, 10, 0}, {0, 0, 30}}};
    Scene scene{fluid, model, 0.1};
    scene.objects = {box_object("tank", solver::Role::container, {0, 0, 0}, {1, 1, 1}),
                     box_object("post", solver::Role::obstacle, {2, 2, 2}, {3, 3, 3})};
    // 10 N upwards with 30 N m about the origin acts at x = 3 m: no torque about there, -20 N m about x = 5 m.
    CHECK(*scene.measure(proto::ForceProbe{"post", {3, 0, 0}})[5] == Approx(0.0).margin(1e-12));
    const auto values = scene.measure(proto::ForceProbe{"post", {5, 0, 0}});
    CHECK(*values[1] == 10.0);
    CHECK(*values[5] == Approx(-20.0));
}
