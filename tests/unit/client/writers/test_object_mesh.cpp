#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "client/writers/object_mesh.h"
#include "client/writers/vec3.h"

using namespace headrace;
using namespace headrace::client;

namespace {

std::vector<Vec3> points_of(const VtpPiece& piece) {
    std::vector<double> numbers(piece.points.bytes.size() / sizeof(double));
    std::memcpy(numbers.data(), piece.points.bytes.data(), piece.points.bytes.size());
    std::vector<Vec3> points;
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
        points.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
    return points;
}

// Of a closed surface, by the divergence theorem: the sum over triangles of a . (b x c) / 6. Positive where normals
// point outwards.
double enclosed_volume(const VtpPiece& piece) {
    const std::vector<Vec3> points = points_of(piece);
    double volume = 0.0;
    std::int32_t begin = 0;
    for (const std::int32_t end : piece.polys.offsets) {
        const auto corner = [&](std::int32_t k) { return points[piece.polys.connectivity[begin + k]]; };
        for (std::int32_t k = 1; k + 1 < end - begin; ++k)
            volume += dot(corner(0), cross(corner(k), corner(k + 1))) / 6;
        begin = end;
    }
    return volume;
}

}  // namespace

TEST_CASE("ObjectMesh.ACylinderIsClosedAndHasItsVolume") {
    const Vec3 from{0.3, -0.2, 1.0}, to{1.5, 0.7, 0.4};
    const double radius = 0.25, length = client::length(to - from);
    const VtpPiece piece =
        make_object_mesh(at_rest({{"log", proto::ObjectRole::obstacle, proto::CylinderDesc{from, to, radius}}}), 3);
    // A prism over a regular polygon of n = 48 corners has sin(2 pi / n) n / (2 pi) of the circle's area: 0.29 % less.
    CHECK(std::abs(enclosed_volume(piece)) == Approx(M_PI * radius * radius * length).epsilon(0.004));
    for (const Vec3& x : points_of(piece)) {
        const Vec3 axis = normalized(to - from);
        const double along = dot(x - from, axis);
        CHECK(client::length(x - from - along * axis) <= radius * (1 + 1e-12));
        CHECK((std::abs(along) < 1e-12 || std::abs(along - length) < 1e-12));
    }
}

TEST_CASE("ObjectMesh.PlanesHaveNoPolygonButStayInTheList") {
    const VtpPiece piece =
        make_object_mesh(at_rest({{"floor", proto::ObjectRole::obstacle, proto::PlaneDesc{{0, 0, 0}, {0, 1, 0}}},
                                  {"box", proto::ObjectRole::obstacle, proto::BoxDesc{{0, 0, 0}, {1, 1, 1}}}}),
                         3);
    CHECK(piece.polys.offsets.size() == 6);
    CHECK(piece.names == std::vector<std::string>{"floor", "box"});
}

TEST_CASE("Perpendiculars.AreRightHanded") {
    for (const Vec3& axis : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0.6, 0, 0.8}}) {
        const auto [first, second] = perpendiculars(axis);
        CHECK(length(cross(first, second) - axis) == Approx(0).margin(1e-12));
        CHECK(length(first) == Approx(1));
    }
}
