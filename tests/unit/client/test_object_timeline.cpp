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

}  // namespace

TEST_CASE("ObjectTimeline.ChangesShowFromTheirStepOn") {
    proto::Event other;
    other.type = "job.started";
    other.step = 50;
    const ObjectTimeline timeline({object("tank"), object("panel")},
                                  {other, change(100, {object("tank")}), change(200, {object("tank"), object("lid")}),
                                   change(200, {object("tank"), object("lid"), object("ball")})});
    CHECK(timeline.at(0).size() == 2);
    CHECK(timeline.at(99).size() == 2);
    CHECK(timeline.at(100).size() == 1);
    CHECK(timeline.at(199).size() == 1);
    CHECK(timeline.at(200).size() == 3);  // the last word of that step
    CHECK(timeline.at(1'000'000).back().name == "ball");
}

TEST_CASE("ObjectTimeline.WithoutEventsNothingChanges") {
    const ObjectTimeline timeline({object("tank")}, {});
    CHECK(timeline.at(0).size() == 1);
    CHECK(timeline.at(7).size() == 1);
}
