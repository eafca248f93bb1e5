#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "server/scene/shapes.h"
#include "server/scene/vectors.h"

using namespace headrace;
using proto::BoxDesc;
using proto::CylinderDesc;
using proto::DifferenceDesc;
using proto::IntersectionDesc;
using proto::PlaneDesc;
using proto::ShapeDesc;
using proto::SphereDesc;
using proto::Vec3;
using scene::contains;

namespace {

const CylinderDesc kLog{{0, 0, 0}, {0, 2, 0}, 0.5};
const ShapeDesc kTube = DifferenceDesc{{kLog, CylinderDesc{{0, -1, 0}, {0, 3, 0}, 0.3}}};
const ShapeDesc kDome = IntersectionDesc{{SphereDesc{{0, 0, 0}, 1.0}, PlaneDesc{{0, 0.2, 0}, {0, -3, 0}}}};

}  // namespace

TEST_CASE("Shapes.CylindersHoldWhatIsBetweenTheirEnds") {
    CHECK(contains(kLog, {0.3, 1.0, 0.39}, 3));
    CHECK_FALSE(contains(kLog, {0.3, 1.0, 0.41}, 3));
    CHECK_FALSE(contains(kLog, {0, 2.01, 0}, 3));
    CHECK(contains(kLog, {0, 2.01, 0}, 3, 0.02));
    CHECK_FALSE(contains(kLog, {0.49, 1.0, 0}, 3, -0.02));
    // Along a slanted axis.
    const CylinderDesc slanted{{1, 1, 1}, {2, 2, 2}, 0.1};
    CHECK(contains(slanted, {1.5, 1.5, 1.5}, 3));
    CHECK_FALSE(contains(slanted, {1.5, 1.5, 1.8}, 3));
}

TEST_CASE("Shapes.PlanesHoldTheSideTheirNormalPointsAwayFrom") {
    const PlaneDesc plane{{0, 1, 0}, {0, 2, 0}};
    CHECK(contains(plane, {7, 0.99, -3}, 3));
    CHECK_FALSE(contains(plane, {7, 1.01, -3}, 3));
    CHECK(contains(plane, {7, 1.01, -3}, 3, 0.02));  // the margin is in m, whatever the normal's length
    CHECK_FALSE(contains(plane, {7, 1.05, -3}, 3, 0.02));
}

TEST_CASE("Shapes.DifferencesAndIntersectionsFollowTheirParts") {
    CHECK(contains(kTube, {0.4, 1, 0}, 3));
    CHECK_FALSE(contains(kTube, {0.2, 1, 0}, 3));
    CHECK(contains(kTube, {0.29, 1, 0}, 3, 0.02));  // grown: the hole shrinks
    CHECK_FALSE(contains(kTube, {0.31, 1, 0}, 3, -0.02));
    CHECK(contains(kDome, {0, 0.3, 0}, 3));
    CHECK_FALSE(contains(kDome, {0, 0.1, 0}, 3));
    CHECK_FALSE(contains(kDome, {0, 1.1, 0}, 3));
    const ShapeDesc nested = DifferenceDesc{{kDome, kTube}};
    CHECK(contains(nested, {0, 0.3, 0}, 3));
    CHECK_FALSE(contains(nested, {0.4, 0.3, 0}, 3));
}

TEST_CASE("Shapes.BoundingBoxesAreTight") {
    const BoxDesc log = scene::bounding_box(kLog);
    CHECK(log.min == Vec3{-0.5, 0, -0.5});
    CHECK(log.max == Vec3{0.5, 2, 0.5});
    CHECK(scene::bounding_box(kTube).max == Vec3{0.5, 2, 0.5});
    CHECK(scene::bounding_box(kDome).min[1] == 0.2);
    CHECK(scene::bounding_box(kDome).max[1] == 1.0);
    const BoxDesc slope = scene::bounding_box(PlaneDesc{{0, 0, 0}, {1, 1, 0}});
    CHECK(slope.max[0] == std::numeric_limits<double>::infinity());
    CHECK_FALSE(proto::is_finite(slope, 2));
    // A slanted cylinder touches its box: 45 degrees in the x-y plane, reach r / sqrt 2 beyond the ends.
    const BoxDesc slanted = scene::bounding_box(CylinderDesc{{0, 0, 0}, {1, 1, 0}, 0.2});
    CHECK(slanted.min[0] == Approx(-0.2 / std::sqrt(2.0)));
    CHECK(slanted.max[1] == Approx(1 + 0.2 / std::sqrt(2.0)));
    CHECK(slanted.max[2] == Approx(0.2));
}

TEST_CASE("Shapes.BoundingBoxesHoldEverythingInside") {
    const unsigned seed = 20251;
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(-2.5, 2.5);
    const ShapeDesc slanted = CylinderDesc{{-1, 0.3, 0.2}, {0.7, -0.5, 1.1}, 0.6};
    for (const ShapeDesc& shape : {ShapeDesc(kLog), kTube, kDome, slanted}) {
        const BoxDesc bounds = scene::bounding_box(shape);
        int inside = 0;
        for (int k = 0; k < 20'000; ++k) {
            const Vec3 x{anywhere(random), anywhere(random), anywhere(random)};
            if (!contains(shape, x, 3)) continue;
            ++inside;
            if (!contains(bounds, x, 3, 1e-12)) FAIL("a point of shape " << shape.index() << " is outside");
        }
        CHECK(inside > 50);
    }
}

TEST_CASE("Shapes.MoveAsAWhole") {
    const Vec3 by{0.3, -0.7, 1.9};
    for (const ShapeDesc& shape : {ShapeDesc(kLog), kTube, kDome, ShapeDesc(PlaneDesc{{0, 1, 0}, {0, 1, 0}})}) {
        const ShapeDesc moved = scene::moved_by(shape, by);
        for (const Vec3& x : {Vec3{0.4, 1, 0}, Vec3{0, 0.3, 0}, Vec3{0, 1.5, 0}, Vec3{0.1, -3, 0}})
            CHECK(contains(moved, scene::plus(x, by), 3) == contains(shape, x, 3));
    }
    CHECK(scene::center_of(PlaneDesc{{0, 1, 0}, {0, 1, 0}}) == Vec3{0, 1, 0});
    CHECK(scene::center_of(kLog) == Vec3{0, 1, 0});
}

TEST_CASE("Shapes.HighestPointsAreThoseOfTheSurface") {
    const Vec3 up{0, 1, 0}, slanted{0.6, 0.8, 0};
    CHECK(scene::highest_point(BoxDesc{{0, 0, 0}, {1, 2, 3}}, up, 3) == 2.0);
    CHECK(scene::highest_point(BoxDesc{{0, 0, 0}, {1, 2, 3}}, slanted, 3) == Approx(2.2));
    CHECK(scene::highest_point(SphereDesc{{1, 1, 0}, 0.5}, slanted, 3) == Approx(1.9));
    CHECK(scene::highest_point(kLog, up, 3) == Approx(2.0));
    CHECK(scene::highest_point(kLog, {1, 0, 0}, 3) == Approx(0.5));
    // A bowl filled to 0.2: the lid is the highest point, not the sphere's top.
    const ShapeDesc pool = IntersectionDesc{{SphereDesc{{0, 0, 0}, 1.0}, PlaneDesc{{0, 0.2, 0}, {0, 1, 0}}}};
    CHECK(scene::highest_point(pool, up, 3) == Approx(0.2));
    CHECK(scene::highest_point(kTube, up, 3) == Approx(2.0));
}

TEST_CASE("Shapes.BecomeTheSolversPrimitives") {
    const auto log = std::get<solver::Cylinder>(scene::to_primitive(CylinderDesc{{1, 0, 0}, {1, 2, 0}, 0.5}, 3));
    CHECK(log.center == Vec3{1, 1, 0});
    CHECK(log.axis == Vec3{0, 1, 0});
    CHECK(log.half_length == 1.0);
    CHECK(log.radius == 0.5);
    const auto plane = std::get<solver::Plane>(scene::to_primitive(PlaneDesc{{1, 2, 9}, {0, 5, 0}}, 2));
    CHECK(plane.point == Vec3{1, 2, 0});
    CHECK(plane.normal == Vec3{0, 1, 0});
}
