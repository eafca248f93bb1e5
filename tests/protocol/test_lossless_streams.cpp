// The data socket: single frames, and streams that lose nothing.
#include <catch2/catch.hpp>
#include <memory>
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
    Client data{server->data_endpoint()};
};

std::uint64_t next_seq(Client& data) {
    const std::string message = data.await_frame();
    return frame_of(message).info.seq;
}

Json every_step(int window) {
    return {{"mode", "lossless"}, {"every_steps", 1}, {"window", window}};
}

bool has_event(Client& client, const std::string& type, Seconds patience) {
    const Json reply = client.call("events.since", {{"types", Json::array({type})}, {"timeout", patience.count()}});
    return !reply["events"].empty();
}

}  // namespace

TEST_CASE("DataSocket.FrameGetBringsTheFrameBesideTheReply") {
    Loaded loaded;
    loaded.client.call("sim.step", {{"steps", 7}});
    const Json reply = loaded.data.call("frame.get", {{"fields", {"id", "density"}}});
    const std::string message = loaded.data.await_frame();
    const proto::FrameView frame = frame_of(message);
    CHECK(reply["step"] == 7);
    CHECK(frame.info.step == 7);
    CHECK(reply["bytes"] == message.size());
    CHECK(frame.find(proto::Field::density) != nullptr);
    CHECK(frame.find(proto::Field::position) == nullptr);
}

TEST_CASE("DataSocket.FrameGetIsAnsweredWhileTheRunGoesOn") {
    Loaded loaded;
    loaded.client.call("sim.run", {{"pace", 1e-6}});
    CHECK(loaded.data.call("frame.get")["step"].is_number());
    CHECK(frame_of(loaded.data.await_frame()).info.particle_count == 100);
}

TEST_CASE("DataSocket.RefusesWhatBelongsElsewhere") {
    TestServer server;
    Client data(server->data_endpoint());
    CHECK(data.ask("sim.step").error_name() == "wrong_socket");
    CHECK(data.ask("stream.open", {{"mode", "live"}}).error_name() == "wrong_socket");
    CHECK(data.ask("frame.get").error_name() == "wrong_state");
    CHECK(data.ask("stream.ack", {{"stream", "x"}, {"seq", 1}}).error_name() == "stream_not_found");
    CHECK(data.ask("stream.close", {{"stream", "x"}}).error_name() == "stream_not_found");
    CHECK(data.ask("frame.get", {{"x", 1}}).error_name() == "invalid_params");
    CHECK(data.ask_raw("{").error_name() == "parse_error");
    Client req(server->data_endpoint(), zmq::socket_type::req);
    CHECK(req.ask("frame.get").error_name() == "wrong_state");
}

TEST_CASE("LosslessStreams.TheWindowHoldsTheRunUntilItIsAcknowledged") {
    Loaded loaded;
    const Json stream = loaded.data.call("stream.open", every_step(4));
    CHECK(stream["window"] == 4);
    const std::int64_t run = loaded.client.post("sim.step", {{"steps", 10}});
    for (std::uint64_t seq = 1; seq <= 4; ++seq) CHECK(next_seq(loaded.data) == seq);
    REQUIRE(eventually([&] { return loaded.client.call("sim.status")["stalled"] == true; }));
    CHECK_FALSE(loaded.client.has_arrived(run));
    CHECK(loaded.client.call("sim.status")["step"] == 3);  // the first frame is the state before any step

    // Each acknowledgement lets as many through.
    std::uint64_t seq = 4;
    while (seq < 11) {
        CHECK(loaded.data.call("stream.ack", {{"stream", stream["stream"]}, {"seq", seq}})["acked"] == seq);
        CHECK(next_seq(loaded.data) == seq + 1);
        ++seq;
    }
    CHECK(loaded.client.await(run).result()["step"] == 10);
    const Json closed = loaded.data.call("stream.close", {{"stream", stream["stream"]}});
    CHECK(closed["frames"] == 11);
    CHECK(closed["last_seq"] == 11);
}

TEST_CASE("LosslessStreams.StatusTellsHowFarEachReaderIsBehind") {
    Loaded loaded;
    CHECK_FALSE(loaded.client.call("sim.status").contains("readers"));
    loaded.client.call("stream.open", {{"mode", "live"}});
    const Json stream = loaded.data.call("stream.open", every_step(16));
    loaded.client.call("sim.step", {{"steps", 3}});  // four frames: the first is of the state that was there
    const auto readers = [&] { return loaded.client.call("sim.status")["readers"]; };
    Json now;
    CHECK(eventually([&] { return (now = readers()).size() == 2 && now[1]["frames"] == 4; }));
    CHECK(now[0] == Json({{"stream", "frame/1"}, {"mode", "live"}, {"subscribed", false}, {"frames", 0}}));
    CHECK(now[1]["stream"] == stream["stream"]);
    CHECK(now[1]["behind"] == 4);
    CHECK(now[1]["window"] == 16);
    loaded.data.call("stream.ack", {{"stream", stream["stream"]}, {"seq", 3}});
    CHECK(eventually([&] { return (now = readers())[1]["behind"] == 1; }));
    loaded.data.call("stream.close", {{"stream", stream["stream"]}});
    loaded.data.call("stream.ack", {{"stream", stream["stream"]}, {"seq", 4}});
    CHECK(eventually([&] { return readers().size() == 1; }));
}

TEST_CASE("LosslessStreams.ControlAnswersWhileAReaderHoldsTheRun") {
    Loaded loaded;
    const Json stream = loaded.data.call("stream.open", every_step(1));
    const std::int64_t run = loaded.client.post("sim.step", {{"steps", 10}});
    REQUIRE(eventually([&] { return loaded.client.call("sim.status")["stalled"] == true; }));
    CHECK(loaded.client.call("objects.move", {{"name", "tank"}, {"by", {0, 0}}})["step"] == 0);
    loaded.client.call("sim.cancel");
    CHECK(loaded.client.await(run).result()["state"] == "cancelled");
    CHECK(loaded.client.call("stream.close", {{"stream", stream["stream"]}})["frames"] == 1);
}

TEST_CASE("LosslessStreams.AReconnectResumesWithoutAGap") {
    Loaded loaded;
    auto first = std::make_unique<Client>(loaded.server->data_endpoint());
    const Json stream = first->call("stream.open", every_step(4));
    const std::int64_t run = loaded.client.post("sim.step", {{"steps", 8}});
    for (std::uint64_t seq = 1; seq <= 4; ++seq) CHECK(next_seq(*first) == seq);
    // It has two of them, then its line breaks.
    first.reset();

    const Json resumed =
        loaded.data.call("stream.open", {{"mode", "lossless"}, {"resume", stream["stream"]}, {"acked", 2}});
    CHECK(resumed["stream"] == stream["stream"]);
    CHECK(resumed["next_seq"] == 3);
    for (std::uint64_t seq = 3; seq <= 9; ++seq) {
        CHECK(next_seq(loaded.data) == seq);
        loaded.data.call("stream.ack", {{"stream", stream["stream"]}, {"seq", seq}});
    }
    CHECK(loaded.client.await(run).result()["step"] == 8);
    CHECK(loaded.data.ask("stream.open", {{"mode", "lossless"}, {"resume", "data/99"}}).error_name() ==
          "stream_not_found");
}

TEST_CASE("LosslessStreams.AcknowledgingWhatWasNotSentIsRefused") {
    Loaded loaded;
    const Json stream = loaded.data.call("stream.open", every_step(4));
    next_seq(loaded.data);
    const Answer answer = loaded.data.ask("stream.ack", {{"stream", stream["stream"]}, {"seq", 2}});
    CHECK(answer.error_name() == "invalid_params");
    CHECK(answer.path() == "params.seq");
}

TEST_CASE("LosslessStreams.OnStallFailEndsTheStreamNotTheRun") {
    Loaded loaded;
    Json request = every_step(2);
    request["on_stall"] = "fail";
    const Json stream = loaded.data.call("stream.open", request);
    CHECK(loaded.client.call("sim.step", {{"steps", 10}})["step"] == 10);
    CHECK(has_event(loaded.client, "stream.failed", Seconds(60)));
    CHECK(loaded.data.ask("stream.ack", {{"stream", stream["stream"]}, {"seq", 1}}).error_name() == "stream_not_found");
}

TEST_CASE("LosslessStreams.AReaderThatStopsIsGivenUpAfterItsTimeout") {
    Loaded loaded;
    Json request = every_step(2);
    request["stall_timeout"] = 0.2;
    const Json stream = loaded.data.call("stream.open", request);
    CHECK(loaded.client.call("sim.step", {{"steps", 10}})["step"] == 10);
    CHECK(has_event(loaded.client, "stream.failed", Seconds(60)));
    CHECK(loaded.client.call("sim.status")["stalled"] == false);
}

TEST_CASE("LosslessStreams.AGoneReaderDoesNotDisturbAnother") {
    Loaded loaded;
    Json brief = every_step(2);
    brief["stall_timeout"] = 0.2;
    {
        Client gone(loaded.server->data_endpoint());
        gone.call("stream.open", brief);
    }
    const Json stream = loaded.data.call("stream.open", every_step(20));
    loaded.client.call("sim.step", {{"steps", 10}});
    for (std::uint64_t seq = 1; seq <= 11; ++seq) CHECK(next_seq(loaded.data) == seq);
}
