#include <catch2/catch.hpp>
#include <cmath>

#include "proto/values/motion.h"
#include "server/scene/collision_objects.h"
#include "server/scene/vectors.h"

using namespace headrace;
using proto::Vec3;

namespace {

proto::ObjectDesc paddle() {
    proto::ObjectDesc object{"paddle", proto::ObjectRole::obstacle, proto::BoxDesc{{0, 0, 0}, {0.1, 1, 0.1}}};
    object.motion.emplace();
    return object;
}

solver::CollisionObject made(const proto::ObjectDesc& object, int dimensions = 3) {
    auto collision = scene::make_collision_object(object, dimensions, 0.01, "object");
    if (!collision) FAIL(collision.error().path << ": " << collision.error().message);
    return *collision;
}

std::string refused_path(const proto::ObjectDesc& object, int dimensions = 3) {
    const auto collision = scene::make_collision_object(object, dimensions, 0.01, "object");
    return collision.ok() ? "taken" : collision.error().path;
}

// Where the body's point X is at the time of the state.
Vec3 placed(const solver::RigidState& state, const Vec3& X) {
    const Vec3 arm = scene::minus(X, state.pivot);
    Vec3 x = scene::plus(state.pivot, state.translation);
    for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) x[k] += state.rotation[3 * k + l] * arm[l];
    return x;
}

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

TEST_CASE("CollisionObject.AtRestHasNoMotion") {
    proto::ObjectDesc object = paddle();
    object.motion.reset();
    const solver::CollisionObject collision = made(object);
    CHECK_FALSE(collision.motion);
    CHECK(collision.name == "paddle");
    CHECK(collision.slip == solver::Slip::by_model);
    object.slip = proto::WallSlip::no_slip;
    object.role = proto::ObjectRole::container;
    CHECK(made(object).slip == solver::Slip::no_slip);
    CHECK(made(object).role == solver::Role::container);
}

TEST_CASE("CollisionObject.FollowsItsDisplacement") {
    proto::ObjectDesc object = paddle();
    object.motion->displacement = proto::ScalarVec3{std::string("0.1*sin(2*t)"), 0.5, 0.0};
    const auto motion = made(object).motion;
    REQUIRE(motion);
    const solver::RigidState state = motion(0.3);
    CHECK(state.translation[0] == Approx(0.1 * std::sin(0.6)));
    CHECK(state.translation[1] == 0.5);
    CHECK(state.velocity[0] == Approx(0.2 * std::cos(0.6)).epsilon(1e-8));
    CHECK(state.velocity[1] == 0.0);
    CHECK(state.acceleration[0] == Approx(-0.4 * std::sin(0.6)).epsilon(1e-6));
    CHECK(state.rotation == std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
}

// Pictures show the wall where the fluid feels it.
TEST_CASE("CollisionObject.StandsWhereClientsDrawIt") {
    proto::ObjectDesc object = paddle();
    object.motion->displacement = proto::TableDesc{{{0, 0, 0, 0}, {0.5, 0.1, 0.7, 0}, {1, 0.2, 0, 0.3}}};
    object.motion->angle = proto::Scalar(std::string("0.4*sin(3*t)"));
    object.motion->pivot = {0.3, -0.2, 0.1};
    object.motion->axis = {1, 2, 3};
    const auto drawn = scene::MovingObjects::make({object}, 3, 0.01);
    REQUIRE(drawn.ok());
    const auto motion = made(object).motion;
    for (const double t : {0.0, 0.2, 0.77, 5.0}) {
        const Vec3 corner{0.1, 1, 0};
        const Vec3 gap = scene::minus(drawn->at(t)[0](corner), placed(motion(t), corner));
        CHECK(scene::norm(gap) < 1e-14);  // the sums round in another order
        CHECK((t == 0.0) == (placed(motion(t), corner) == corner));
    }
}

TEST_CASE("CollisionObject.TurnsAboutItsPivot") {
    proto::ObjectDesc object = paddle();
    object.motion->pivot = {1, 2, 0};
    object.motion->axis = {0, 0, 7};
    object.motion->angle = proto::Scalar(std::string("pi/2 * t"));
    const solver::RigidState state = made(object).motion(1.0);
    // A quarter turn, counter-clockwise seen from +z: from the pivot's right to above it.
    const Vec3 x = placed(state, {2, 2, 5});
    CHECK(x[0] == Approx(1.0));
    CHECK(x[1] == Approx(3.0));
    CHECK(x[2] == Approx(5.0));
    CHECK(state.angular_velocity[2] == Approx(M_PI / 2).epsilon(1e-9));
    CHECK(state.angular_acceleration[2] == Approx(0.0).margin(1e-6));
}

TEST_CASE("CollisionObject.VelocitiesAreThoseOfItsPlaces") {
    proto::ObjectDesc object = paddle();
    object.motion->pivot = {0.2, -0.1, 0.3};
    object.motion->axis = {1, 2, -2};
    object.motion->angle = proto::Scalar(std::string("0.3*sin(3*t) + t"));
    object.motion->displacement = proto::ScalarVec3{std::string("t^2"), std::string("cos(t)"), std::string("-t")};
    const auto motion = made(object).motion;
    const Vec3 X{0.7, 0.4, -0.6};
    const double t = 0.4, h = 1e-4;  // errors of the differences: h^2 about 1e-7, rounding 1e-8 in the second
    const solver::RigidState state = motion(t);
    const Vec3 before = placed(motion(t - h), X), here = placed(state, X), after = placed(motion(t + h), X);
    const Vec3 arm = scene::minus(here, scene::plus(state.pivot, state.translation));
    const Vec3 v = scene::plus(state.velocity, cross(state.angular_velocity, arm));
    const Vec3 a =
        scene::plus(state.acceleration, scene::plus(cross(state.angular_acceleration, arm),
                                                    cross(state.angular_velocity, cross(state.angular_velocity, arm))));
    for (int k = 0; k < 3; ++k) {
        CAPTURE(k);
        CHECK(v[k] == Approx((after[k] - before[k]) / (2 * h)).margin(1e-6));
        CHECK(a[k] == Approx((after[k] - 2 * here[k] + before[k]) / (h * h)).margin(1e-5));
    }
}

TEST_CASE("CollisionObject.MovesByTables") {
    proto::ObjectDesc object = paddle();
    object.motion->displacement = proto::TableDesc{{{0, 0, 0}, {1, 2, 0}, {2, 4, 0}}};
    object.motion->angle = proto::TableDesc{{{0, 0}, {2, 1}}};
    const solver::RigidState state = made(object, 2).motion(0.5);
    CHECK(state.translation == Vec3{1, 0, 0});
    CHECK(state.velocity[0] == Approx(2.0));
    CHECK(state.angular_velocity[2] == Approx(0.5));
    const solver::RigidState later = made(object, 2).motion(9.0);
    CHECK(later.translation[0] == 4.0);
    CHECK(later.velocity[0] == 0.0);
}

TEST_CASE("CollisionObject.SurfaceMayRunInItself") {
    proto::ObjectDesc object = paddle();
    object.motion.reset();
    object.surface_velocity = proto::ScalarVec3{std::string("min(t, 1)"), 0.0, 0.0};
    const auto motion = made(object).motion;
    REQUIRE(motion);
    CHECK(motion(0.25).surface_velocity == Vec3{0.25, 0, 0});
    CHECK(motion(2.0).surface_velocity == Vec3{1, 0, 0});
    CHECK(motion(2.0).velocity == Vec3{});
    CHECK(motion(2.0).translation == Vec3{});
}

TEST_CASE("CollisionObject.RefusalsNameTheMember") {
    proto::ObjectDesc object = paddle();
    object.motion->displacement = proto::ScalarVec3{0.0, std::string("x"), 0.0};
    CHECK(refused_path(object) == "object.motion.displacement[1]");
    object.motion->displacement = proto::TableDesc{{{0, 0}, {1, 1}}};
    CHECK(refused_path(object) == "object.motion.displacement.table[0]");
    object.motion->displacement.reset();
    object.motion->angle = proto::Scalar(std::string("sqrt(t - 1)"));
    CHECK(refused_path(object) == "object.motion.angle");
    object.motion->angle = proto::Scalar(std::string("sqrt(t)"));  // infinitely fast at t = 0
    CHECK(refused_path(object) == "object.motion.angle");
    object.motion->angle.reset();
    object.motion->axis = {};
    CHECK(refused_path(object) == "object.motion.axis");
    CHECK(refused_path(object, 2) == "taken");  // 2D: always z
    object.motion->axis = {0, 0, 1};
    object.surface_velocity = proto::ScalarVec3{std::string("1/t"), 0.0, 0.0};
    CHECK(refused_path(object) == "object.surface_velocity");
}

TEST_CASE("CollisionObject.TakesItsPivotAlongWhenItIsMoved") {
    proto::ObjectDesc object = paddle();
    object.motion->pivot = {1, 0, 0};
    const proto::ObjectDesc moved = scene::moved_by(object, {0, 2, 0});
    CHECK(moved.motion->pivot == Vec3{1, 2, 0});
    CHECK(std::get<proto::BoxDesc>(moved.shape).min == Vec3{0, 2, 0});
}

TEST_CASE("CollisionObject.HoldsFluidOnItsOwnSideWhereItIs") {
    const auto may = [](const proto::ObjectDesc& object, const Vec3& x) {
        const solver::CollisionObject collision = made(object);
        std::optional<solver::RigidState> state;
        if (collision.motion) state = collision.motion(0.0);
        return scene::may_hold_fluid(object, state, x, 3, 1e-9);
    };
    proto::ObjectDesc floor{"floor", proto::ObjectRole::container, proto::PlaneDesc{{0, 0, 0}, {0, 1, 0}}};
    for (const auto role : {proto::ObjectRole::container, proto::ObjectRole::obstacle}) {
        floor.role = role;  // of a plane the normal tells
        CHECK(may(floor, {5, 0.01, 5}));
        CHECK_FALSE(may(floor, {5, -0.01, 5}));
    }
    proto::ObjectDesc pipe{"pipe", proto::ObjectRole::container, proto::CylinderDesc{{0, 0, 0}, {1, 0, 0}, 0.2}};
    CHECK(may(pipe, {0.5, 0.1, 0}));
    CHECK_FALSE(may(pipe, {0.5, 0.3, 0}));
    pipe.role = proto::ObjectRole::obstacle;
    CHECK(may(pipe, {0.5, 0.3, 0}));
    // A paddle that starts a quarter turn from where the document draws it.
    proto::ObjectDesc turned = paddle();
    turned.motion->angle = proto::Scalar(std::string("pi/2"));
    CHECK(may(turned, {0.05, 0.5, 0.05}));
    CHECK_FALSE(may(turned, {-0.5, 0.05, 0.05}));
}
