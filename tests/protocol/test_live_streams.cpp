// Live streams on the frames socket: lossy, and free when nobody looks.
#include <catch2/catch.hpp>
#include <string>

#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;

namespace {

struct Loaded {
    Loaded() { client.call("scene.load", {{"scene", pond()}}); }

    TestServer server;
    Client client{server->control_endpoint()};
};

}  // namespace

TEST_CASE("LiveStreams.CarryFramesOfTheRun") {
    Loaded loaded;
    const Json stream = loaded.client.call("stream.open", {{"fields", {"id", "position"}}, {"precision", "f8"}});
    CHECK(stream["mode"] == "live");
    Subscriber viewer(loaded.server->frames_endpoint(), stream["stream"].get<std::string>());
    // Who joins gets the present state, also while nothing runs.
    const std::string first = viewer.receive("first frame");
    const proto::FrameView still = frame_of(first);
    CHECK(still.info.topic == stream["stream"]);
    CHECK(still.info.step == 0);
    CHECK(still.info.particle_count == 100);
    REQUIRE(still.columns.size() == 2);
    CHECK(still.columns[1].dtype == "<f8");
    CHECK(still.columns[1].components == 2);

    loaded.client.call("sim.run", {{"pace", 1}});
    std::uint64_t seq = still.info.seq;
    double time = still.info.time;
    for (int k = 0; k < 5; ++k) {
        const std::string message = viewer.receive("next frame");
        const proto::FrameView frame = frame_of(message);
        CHECK(frame.info.seq > seq);
        CHECK(frame.info.time > time);
        seq = frame.info.seq;
        time = frame.info.time;
    }
    CHECK(loaded.client.call("sim.status")["streams"] == 1);
    loaded.client.call("sim.cancel");
    CHECK(loaded.client.call("stream.close", {{"stream", stream["stream"]}})["frames"].get<std::uint64_t>() >= seq);
    CHECK(loaded.client.call("sim.status")["streams"] == 0);
}

TEST_CASE("LiveStreams.NothingIsEncodedForNobody") {
    Loaded loaded;
    const Json stream = loaded.client.call("stream.open");
    // Another topic's reader changes nothing.
    Subscriber other(loaded.server->frames_endpoint(), "frame/77");
    loaded.client.call("sim.step", {{"steps", 50}});
    CHECK(loaded.client.call("stream.close", {{"stream", stream["stream"]}})["frames"] == 0);
}

TEST_CASE("LiveStreams.ATopicDoesNotMatchALongerOne") {
    Loaded loaded;
    for (int k = 0; k < 10; ++k) loaded.client.call("stream.open", {{"fields", {"id"}}});
    Subscriber tenth(loaded.server->frames_endpoint(), "frame/10");
    Subscriber first(loaded.server->frames_endpoint(), "frame/1");
    tenth.receive("frame of the tenth");
    const std::string message = first.receive("frame of the first");
    CHECK(frame_of(message).info.topic == "frame/1");
    loaded.client.call("sim.step", {{"steps", 5}});
    while (const auto more = first.try_receive(Seconds(0.1))) CHECK(frame_of(*more).info.topic == "frame/1");
}

TEST_CASE("LiveStreams.TheRateHolds") {
    Loaded loaded;
    const Json stream = loaded.client.call("stream.open", {{"rate", 1e-3}});
    Subscriber viewer(loaded.server->frames_endpoint(), stream["stream"].get<std::string>());
    viewer.receive("first frame");
    loaded.client.call("sim.step", {{"steps", 50}});
    // One frame in a thousand seconds.
    CHECK(loaded.client.call("stream.close", {{"stream", stream["stream"]}})["frames"] == 1);
}

TEST_CASE("LiveStreams.UnknownOnesAndTooManyAreRefused") {
    Loaded loaded;
    CHECK(loaded.client.ask("stream.close", {{"stream", "frame/1"}}).error_name() == "stream_not_found");
    CHECK(loaded.client.ask("stream.open", {{"fields", {"colour"}}}).error_name() == "invalid_params");
    Answer answer;
    int opened = 0;
    do answer = loaded.client.ask("stream.open");
    while (answer.ok() && ++opened < 1000);
    CHECK(answer.error_name() == "limit_exceeded");
}

TEST_CASE("LiveStreams.AReaderThatStopsHoldsNobodyUp") {
    Loaded loaded;
    const Json stream = loaded.client.call("stream.open");
    Subscriber lazy(loaded.server->frames_endpoint(), stream["stream"].get<std::string>());
    lazy.receive("first frame");
    Subscriber eager(loaded.server->frames_endpoint(), stream["stream"].get<std::string>());
    eager.receive("first frame");
    CHECK(loaded.client.call("sim.step", {{"steps", 2000}})["step"] == 2000);
    CHECK(eager.try_receive(kPatience).has_value());
}
