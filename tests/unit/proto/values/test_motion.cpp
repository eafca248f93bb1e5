#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "proto/values/motion.h"

using namespace headrace;
using proto::Vec3;

namespace {

proto::MotionDesc swing() {
    proto::MotionDesc desc;
    desc.angle = proto::Scalar(std::string("pi/2*t"));
    desc.pivot = {1, 2, 0};
    return desc;
}

scene::Motion made(const proto::MotionDesc& desc, int dimensions = 3) {
    auto motion = scene::Motion::make(desc, dimensions, 0.01, "motion");
    if (!motion) FAIL(motion.error().path << ": " << motion.error().message);
    return *motion;
}

}  // namespace

TEST_CASE("Motion.TurnsAboutThePivotAndIsThenDisplaced") {
    proto::MotionDesc desc = swing();
    desc.axis = {0, 0, 5};
    desc.displacement = proto::ScalarVec3{0.5, std::string("2*t"), 0.0};
    const scene::Placement place = made(desc).at(1.0);
    // From the pivot's right to above it, then (0.5, 2).
    const Vec3 x = place({2, 2, 7});
    CHECK(x[0] == Approx(1.5));
    CHECK(x[1] == Approx(5.0));
    CHECK(x[2] == Approx(7.0));
    CHECK(place.is_turned());
    CHECK(made(desc).at(0.0)({2, 2, 7}) == Vec3{2.5, 2, 7});
}

TEST_CASE("Motion.DirectionsOnlyTurn") {
    const Vec3 up = made(swing()).at(1.0).turned({1, 0, 0});
    CHECK(up[0] == Approx(0).margin(1e-15));
    CHECK(up[1] == Approx(1));
}

TEST_CASE("Motion.FlatScenesTurnAboutZ") {
    proto::MotionDesc desc = swing();
    desc.axis = {1, 0, 0};  // without meaning in 2D
    CHECK(made(desc, 2).at(1.0)({2, 2, 0})[1] == Approx(3));
}

TEST_CASE("Motion.WithoutPartsStaysWhereItIs") {
    CHECK(made({}).at(3.0) == scene::Placement{});
    CHECK_FALSE(made({}).at(3.0).is_turned());
}

TEST_CASE("Motion.RefusalsNameTheirPlace") {
    proto::MotionDesc desc = swing();
    desc.axis = {};
    CHECK(scene::Motion::make(desc, 3, 0.01, "here").error().path == "here.axis");
    desc = swing();
    desc.pivot[1] = NAN;
    CHECK(scene::Motion::make(desc, 3, 0.01, "here").error().path == "here.pivot");
}

TEST_CASE("MovingObjects.OnlyThoseWithAMotionMove") {
    proto::ObjectDesc rests{"rests"}, moves{"moves"}, breaks{"breaks"};
    moves.motion = swing();
    breaks.motion.emplace();
    breaks.motion->displacement = proto::ScalarVec3{std::string("sqrt(1-t)"), 0.0, 0.0};  // no number after t = 1
    const auto objects = scene::MovingObjects::make({rests, moves, breaks}, 3, 0.01);
    REQUIRE(objects.ok());
    CHECK(objects->at(2.0)[0] == scene::Placement{});
    CHECK(objects->at(2.0)[1].is_turned());
    CHECK(objects->at(0.0)[2].translation[0] == 1);
    CHECK(objects->at(2.0)[2] == scene::Placement{});
}
