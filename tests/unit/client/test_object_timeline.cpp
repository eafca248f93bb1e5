#include <catch2/catch.hpp>

#include "client/object_timeline.h"

using namespace headrace;
using namespace headrace::client;

namespace {

proto::ObjectDesc object(const std::string& name) {
    proto::ObjectDesc desc;
    desc.name = name;
    return desc;
}

proto::Event change(std::uint64_t step, std::vector<proto::ObjectDesc> objects) {
    proto::Event event;
    event.type = "object.removed";
    event.step = step;
    event.objects = std::move(objects);
    return event;
}

ObjectTimeline made(std::vector<proto::ObjectDesc> initial, const std::vector<proto::Event>& events) {
    proto::SceneDesc scene;
    scene.spacing = 0.01;
    auto timeline = ObjectTimeline::make(std::move(initial), events, scene);
    if (!timeline) FAIL(timeline.error().path << ": " << timeline.error().message);
    return *std::move(timeline);
}

}  // namespace

TEST_CASE("ObjectTimeline.ChangesShowFromTheirStepOn") {
    proto::Event other;
    other.type = "job.started";
    other.step = 50;
    const ObjectTimeline timeline =
        made({object("tank"), object("panel")},
             {other, change(100, {object("tank")}), change(200, {object("tank"), object("lid")}),
              change(200, {object("tank"), object("lid"), object("ball")})});
    CHECK(timeline.at(0, 0).size() == 2);
    CHECK(timeline.at(99, 0).size() == 2);
    CHECK(timeline.at(100, 0).size() == 1);
    CHECK(timeline.at(199, 0).size() == 1);
    CHECK(timeline.at(200, 0).size() == 3);  // the last word of that step
    CHECK(timeline.at(1'000'000, 0).back().desc.name == "ball");
}

TEST_CASE("ObjectTimeline.WithoutEventsNothingChanges") {
    const ObjectTimeline timeline = made({object("tank")}, {});
    CHECK(timeline.at(0, 0).size() == 1);
    CHECK(timeline.at(7, 0).size() == 1);
}

// The motion is a function of the absolute time, whatever happened before; what a command moved has a new start.
TEST_CASE("ObjectTimeline.MovingObjectsStandWhereTheirMotionSays") {
    proto::ObjectDesc panel = object("panel");
    panel.shape = proto::BoxDesc{{0, 0, 0}, {1, 1, 1}};
    panel.motion.emplace();
    panel.motion->displacement = proto::TableDesc{{{0, 0, 0, 0}, {1, 0, 0.5, 0}}};
    panel.motion->angle = proto::Scalar(std::string("pi/2*t + 0*dx"));
    panel.motion->pivot = {1, 0, 0};
    proto::ObjectDesc moved = panel;
    moved.shape = proto::BoxDesc{{10, 0, 0}, {11, 1, 1}};
    moved.motion->pivot = {11, 0, 0};
    const ObjectTimeline timeline = made({panel}, {change(100, {moved})});

    CHECK(timeline.at(5, 0)[0].place({0, 0, 0}) == proto::Vec3{0, 0, 0});
    // A quarter turn about (1, 0), then half a metre up: the corner at the origin comes below the pivot.
    for (const auto& [step, shift] : {std::pair{99, 0.0}, std::pair{100, 10.0}}) {
        const proto::Vec3 corner = timeline.at(static_cast<std::uint64_t>(step), 1.0)[0].place({shift, 0, 0});
        CHECK(corner[0] == Approx(shift + 1));
        CHECK(corner[1] == Approx(-0.5));
    }
    CHECK(timeline.at(5, 0.5)[0].place.translation[1] == Approx(0.25));
}

TEST_CASE("ObjectTimeline.AMotionThatCannotBeEvaluatedIsNamed") {
    proto::ObjectDesc panel = object("panel");
    panel.motion.emplace();
    panel.motion->angle = proto::Scalar(std::string("omega*t"));
    const auto timeline = ObjectTimeline::make({object("tank"), panel}, {}, {});
    REQUIRE_FALSE(timeline.ok());
    CHECK(timeline.error().path == "objects[1].motion.angle");
    CHECK(timeline.error().message.find("step") == std::string::npos);

    // One that came with a command: since when.
    const auto later = ObjectTimeline::make({object("tank")}, {change(70, {panel})}, {});
    REQUIRE_FALSE(later.ok());
    CHECK(later.error().path == "objects[0].motion.angle");
    CHECK(later.error().message.ends_with(", of the objects from step 70 on"));
}

TEST_CASE("ObjectTimeline.OfNothingHasNoObjects") {
    CHECK(ObjectTimeline().at(0, 0).empty());
    CHECK_FALSE(ObjectTimeline().has_changes());
    CHECK_FALSE(made({object("tank")}, {}).has_changes());
    CHECK(made({object("tank")}, {change(100, {})}).has_changes());
}
