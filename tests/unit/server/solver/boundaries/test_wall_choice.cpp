// Which objects can be walls as integrals of the kernel.
#include <catch2/catch.hpp>

#include "server/solver/boundaries/wall_choice.h"

using namespace headrace::solver;

namespace {

constexpr double kSupport = 0.1;  // [m]
const Domain kOpen{{-5, -5, -5}, {5, 5, 5}};

CollisionObject container(const Vec3& center, const Vec3& half) {
    return {"container", Role::container, Box{center, half}};
}
CollisionObject block(const Vec3& center, const Vec3& half) {
    return {"block", Role::obstacle, Box{center, half}};
}
CollisionObject ball(const Vec3& center, double radius) {
    return {"ball", Role::obstacle, Sphere{center, radius}};
}
CollisionObject plane(const Vec3& point, const Vec3& normal) {
    return {"plane", Role::obstacle, Plane{point, normal}};
}

// "1101": of each object.
std::string choose(const std::vector<CollisionObject>& objects, const Domain& domain = kOpen) {
    std::string text;
    for (const char chosen : choose_integral_walls(objects, domain, 3, kSupport).is_integral)
        text += chosen ? '1' : '0';
    return text;
}

const CollisionObject kTank = container({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5});

}  // namespace

TEST_CASE("WallChoice.TakesRoomsAndWhatTouchesThemFromInside") {
    CHECK(choose({kTank}) == "1");
    CHECK(choose({kTank, block({0.5, 0.15, 0.5}, {0.15, 0.15, 0.5})}) == "11");
    CHECK(choose({kTank, ball({0.5, 0.2, 0.5}, 0.2), block({0.8, 0.2, 0.5}, {0.1, 0.2, 0.1})}) == "111");
    CHECK(choose({plane({0, 0, 0}, {0, 1, 0}), plane({0, 1, 0}, {0, -1, 0}), kTank}) == "111");
    CHECK(choose({{"bowl", Role::container, Sphere{{0, 0, 0}, 1.0}}}) == "1");
    CHECK(choose({}).empty());
}

TEST_CASE("WallChoice.LeavesOverlappingSolidsToParticles") {
    const CollisionObject step = block({0.5, 0.1, 0.5}, {0.2, 0.2, 0.2});  // reaches into the floor
    CHECK(choose({kTank, step}) == "00");
    CHECK(choose({step, kTank, ball({0.5, 0.8, 0.5}, 0.15)}) == "001");
    CHECK(choose({kTank, block({0.3, 0.5, 0.5}, {0.2, 0.2, 0.2}), block({0.6, 0.5, 0.5}, {0.2, 0.2, 0.2})}) == "100");
    CHECK(choose({kTank, {"bowl", Role::container, Sphere{{0.5, 0.5, 0.5}, 0.4}}}) == "00");
}

TEST_CASE("WallChoice.LeavesOtherShapesToParticles") {
    const CollisionObject pole{"pole", Role::obstacle, Cylinder{{0.5, 0.5, 0.5}, {0, 1, 0}, 0.2, 0.3}};
    CHECK(choose({kTank, pole}) == "10");
    CHECK(choose({kTank, block({0.5, 0.5, 0.5}, {0.05, 0.3, 0.3})}) == "10");  // a panel
    CHECK(choose({kTank, ball({0.5, 0.5, 0.5}, 0.05)}) == "10");
    CHECK(choose({plane({0, 0, 0}, {0, 0.8, 0.6})}) == "0");
    CHECK(choose({kTank, plane({0, 0, 0}, {0, 0.8, 0.6})}) == "00");  // cuts off a corner of the tank
}

TEST_CASE("WallChoice.LeavesAllToParticlesWhereAnythingMoves") {
    CollisionObject piston = block({0.5, 0.5, 0.5}, {0.2, 0.2, 0.2});
    piston.motion = [](double) { return RigidState{}; };
    CHECK(choose({kTank, piston}) == "00");
    piston.is_belt = true;
    CHECK(choose({kTank, piston}) == "11");
}

TEST_CASE("WallChoice.MindsPeriods") {
    const Domain channel{{0, -1, -1}, {1, 2, 2}, {true, false, false}};
    CHECK(choose({container({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5})}, channel) == "1");  // no ends along the period
    CHECK(choose({container({0.5, 0.5, 0.5}, {0.4, 0.5, 0.5})}, channel) == "0");
    CHECK(choose({ball({0.5, 0.5, 0.5}, 0.3)}, channel) == "1");
    CHECK(choose({ball({0.5, 0.5, 0.5}, 0.45)}, channel) == "0");  // seen from both sides
}

TEST_CASE("WallChoice.LimitsHowManyObstaclesAreAskedAbout") {
    std::vector<CollisionObject> objects{container({0.5, 0.5, 0.5}, {5, 5, 5})};
    for (std::size_t k = 0; k < IntegralWalls::kMostObstacles; ++k)
        objects.push_back(ball({static_cast<double>(k), 0.0, 0.0}, 0.2));
    CHECK(choose(objects) == "1111111");
    objects.push_back(ball({0.0, 2.0, 0.0}, 0.2));
    CHECK(choose(objects) == "10000000");
}

TEST_CASE("WallChoice.ByDefaultIsAllOrNone") {
    const auto choose_by_default = [](const std::vector<CollisionObject>& objects, int dimensions, char no_slip) {
        std::string text;
        for (const char chosen :
             choose_walls_by_default(objects, kOpen, dimensions, kSupport, std::vector<char>(objects.size(), no_slip))
                 .is_integral)
            text += chosen ? '1' : '0';
        return text;
    };
    const CollisionObject step = block({0.5, 0.15, 0.5}, {0.15, 0.15, 0.5});
    CHECK(choose_by_default({kTank, step}, 3, 0) == "11");
    CHECK(choose_by_default({kTank, step}, 2, 0) == "00");
    CHECK(choose_by_default({kTank, step}, 3, 1) == "00");
    CHECK(choose_by_default({kTank, ball({0.5, 0.5, 0.5}, 0.2)}, 3, 0) == "00");
    CHECK(choose_by_default({kTank, block({0.5, 0.5, 0.5}, {0.05, 0.3, 0.3})}, 3, 0) == "00");
}
