#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "server/scene/sampling.h"
#include "server/scene/shapes.h"

using namespace headrace;

namespace {

std::vector<proto::Vec3> points_of(const proto::ShapeDesc& shape, int dimensions, double spacing) {
    std::vector<proto::Vec3> points;
    scene::for_each_lattice_point(shape, dimensions, spacing, [&](const proto::Vec3& x) {
        points.push_back(x);
        return true;
    });
    return points;
}

}  // namespace

TEST_CASE("Sampling.ABoxOfWholeSpacingsGivesTheirProductWhateverTheRounding") {
    const double spacing = GENERATE(0.1, 0.027159, 1.0 / 3.0, 0.0085);
    const proto::BoxDesc box{{0.3, -1.0, 2.0}, {0.3 + 10 * spacing, -1.0 + 20 * spacing, 2.0 + 15 * spacing}};
    CHECK(points_of(box, 3, spacing).size() == 3'000);
    CHECK(scene::lattice_size(box, 3, spacing) == 3'000);
    CHECK(points_of(box, 2, spacing).size() == 200);
}

TEST_CASE("Sampling.PointsAreCellCentres") {
    const auto points = points_of(proto::BoxDesc{{0, 0, 0}, {0.2, 0.1, 0.1}}, 3, 0.1);
    REQUIRE(points.size() == 2);
    CHECK(points[0][0] == Approx(0.05));
    CHECK(points[1][0] == Approx(0.15));
    CHECK(points[0][2] == Approx(0.05));
}

TEST_CASE("Sampling.ASphereIsFilledToItsVolume") {
    // The number of lattice points in a sphere of radius r spacings deviates from its volume by less than the cells its
    // surface cuts; a tenth of 4 pi r^2 is generous at r = 10 (measured well below).
    const double radius = 1.0, spacing = 0.1;
    const double ratio = radius / spacing;
    const auto points = points_of(proto::SphereDesc{{1.0, 2.0, 3.0}, radius}, 3, spacing);
    const double pi = std::acos(-1.0);
    CHECK(std::abs(static_cast<double>(points.size()) - 4.0 / 3.0 * pi * std::pow(ratio, 3)) <
          0.1 * 4.0 * pi * ratio * ratio);
    for (const auto& x : points) CHECK(std::hypot(x[0] - 1.0, x[1] - 2.0, x[2] - 3.0) <= radius);
}

TEST_CASE("Sampling.AbsurdSizesSaturateInsteadOfOverflowing") {
    const double big = 1e300;
    CHECK(scene::lattice_size(proto::BoxDesc{{-big, -big, -big}, {big, big, big}}, 3, 1e-9) > 1'000'000'000);
}

TEST_CASE("Shapes.AMovedShapeKeepsItsSize") {
    const proto::ShapeDesc box = proto::BoxDesc{{0, 0, 0}, {1, 2, 3}};
    CHECK(scene::center_of(scene::moved_by(box, {1, 1, 1})) == proto::Vec3{1.5, 2.0, 2.5});
    CHECK(scene::contains(box, {0.5, 0.5, 9.0}, 2));
    CHECK_FALSE(scene::contains(box, {0.5, 0.5, 9.0}, 3));
    CHECK(scene::contains(box, {1.05, 0.5, 0.5}, 3, 0.1));
}
