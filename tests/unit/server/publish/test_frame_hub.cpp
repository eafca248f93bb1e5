#include <catch2/catch.hpp>
#include <memory>

#include "server/publish/frame_hub.h"

using namespace headrace;
using namespace headrace::publish;

namespace {

// A simulation of steps of dt, as the hub sees it.
struct Steps {
    FrameHub& hub;
    double dt{0.01};  // [s]
    std::uint64_t step{0};
    int copies{0};

    void capture() {
        const Moment now{step, static_cast<double>(step) * dt, std::chrono::steady_clock::time_point{}};
        hub.capture_due(now, [&](proto::FieldSet, proto::Precision) {
            ++copies;
            auto capture = std::make_shared<Capture>();
            capture->step = step;
            return capture;
        });
    }
    void run(int steps) {
        for (int k = 0; k < steps; ++k) {
            ++step;
            capture();
        }
    }
};

Demand demand_every(std::int64_t steps, std::int64_t credits, WhenFull when_full) {
    Demand demand;
    demand.fields = {proto::Field::position};
    demand.trigger = Trigger::every_steps;
    demand.every_steps = steps;
    demand.credits = credits;
    demand.when_full = when_full;
    return demand;
}

}  // namespace

TEST_CASE("FrameHub.CopiesNothingWhenNobodyAsks") {
    FrameHub hub;
    Steps steps{hub};
    steps.capture();
    steps.run(10);
    CHECK(steps.copies == 0);
    CHECK(hub.may_step());
}

TEST_CASE("FrameHub.AnInactiveDemandCostsNothing") {
    FrameHub hub;
    Steps steps{hub};
    const DemandId id = hub.add(demand_every(1, 100, WhenFull::skip), false);
    steps.run(5);
    CHECK(steps.copies == 0);
    hub.set_active(id, true);
    steps.run(5);
    CHECK(steps.copies == 5);
}

TEST_CASE("FrameHub.IntervalGivesTheFirstStateAndOneFramePerInterval") {
    FrameHub hub;
    Steps steps{hub};
    Demand demand = demand_every(1, 1'000, WhenFull::hold);
    demand.trigger = Trigger::interval;
    demand.interval = 0.03;  // three steps of 0.01 s; sums of 0.01 are not exact, so this also tests the slack
    hub.add(demand);
    steps.capture();
    steps.run(300);
    const auto captures = hub.take();
    REQUIRE(captures.size() == 101);
    for (std::size_t k = 0; k < captures.size(); ++k) CHECK(captures[k].capture->step == 3 * k);
}

TEST_CASE("FrameHub.AnIntervalBelowTheStepGivesEachStepOnce") {
    FrameHub hub;
    Steps steps{hub};
    Demand demand = demand_every(1, 1'000, WhenFull::hold);
    demand.trigger = Trigger::interval;
    demand.interval = 0.003;
    hub.add(demand);
    steps.capture();
    steps.capture();  // asked again at the same step
    steps.run(10);
    CHECK(hub.take().size() == 11);
}

TEST_CASE("FrameHub.AHoldingDemandStopsTheRunUntilReleased") {
    FrameHub hub;
    Steps steps{hub};
    int woken = 0;
    hub.set_waker([&] { ++woken; });
    const DemandId id = hub.add(demand_every(1, 2, WhenFull::hold));
    steps.capture();
    CHECK(hub.may_step());
    steps.run(1);
    CHECK_FALSE(hub.may_step());
    CHECK(hub.holding_since(id).has_value());
    const int before = woken;
    hub.release(id);
    CHECK(woken == before + 1);
    CHECK(hub.may_step());
    CHECK_FALSE(hub.holding_since(id).has_value());
}

TEST_CASE("FrameHub.ASkippingDemandNeverHoldsTheRun") {
    FrameHub hub;
    Steps steps{hub};
    hub.add(demand_every(1, 2, WhenFull::skip));
    steps.run(10);
    CHECK(hub.may_step());
    CHECK(hub.take().size() == 2);
}

TEST_CASE("FrameHub.AFailingDemandIsRemovedAtTheFirstOverrun") {
    FrameHub hub;
    Steps steps{hub};
    const DemandId id = hub.add(demand_every(1, 2, WhenFull::fail));
    steps.run(2);
    CHECK(hub.take_failed().empty());
    steps.run(3);
    CHECK(hub.take_failed() == std::vector<DemandId>{id});
    CHECK(hub.take().size() == 2);
}

TEST_CASE("FrameHub.DemandsOfOnePrecisionShareACopy") {
    FrameHub hub;
    Steps steps{hub};
    hub.add(demand_every(1, 10, WhenFull::hold));
    hub.add(demand_every(1, 10, WhenFull::hold));
    steps.run(1);
    CHECK(steps.copies == 1);
    const auto captures = hub.take();
    REQUIRE(captures.size() == 2);
    CHECK(captures[0].capture == captures[1].capture);
}

TEST_CASE("FrameHub.ARestartGivesEverybodyTheNewStateInANewGeneration") {
    FrameHub hub;
    Steps steps{hub};
    hub.add(demand_every(1'000, 10, WhenFull::hold));
    steps.run(5);
    CHECK(hub.take().size() == 1);
    const auto generation = hub.generation();
    hub.restart();
    CHECK(hub.generation() == generation + 1);
    steps.step = 0;
    steps.capture();
    CHECK(hub.take().size() == 1);
}

TEST_CASE("FrameHub.OnceMeansOnce") {
    FrameHub hub;
    Steps steps{hub};
    Demand demand;
    demand.fields = {proto::Field::id};
    demand.when_full = WhenFull::skip;
    hub.add(demand);
    steps.capture();
    steps.run(5);
    CHECK(hub.take().size() == 1);
    CHECK(hub.may_step());
}
