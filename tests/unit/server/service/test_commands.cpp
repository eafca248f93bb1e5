// The commands without threads or sockets: what they hand over, and what they answer.
#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "proto/envelope.h"
#include "server/service/commands.h"
#include "server/service/limits.h"

using namespace headrace;
using proto::ErrorCode;
using proto::Json;
using proto::Result;
using server::Token;

namespace {

struct Bench {
    Bench() { server::add_commands(table, context); }

    // Sends a request; what it answers at once, or null.
    Json ask(const std::string& method, const Json& params = Json::object()) {
        replies.clear();
        const Json request{{"jsonrpc", "2.0"}, {"id", 1}, {"method", method}, {"params", params}};
        table.handle(request.dump(), [this](const std::string& text) { replies.push_back(Json::parse(text)); });
        REQUIRE(replies.size() <= 1);
        return replies.empty() ? Json() : replies[0];
    }
    // The other threads' answer to the last request, and the reply it makes.
    Json resolve(Token token, Result<proto::Reply> result) {
        context.pending.resolve({token, std::move(result)});
        REQUIRE(replies.size() == 1);
        return replies[0];
    }
    void set_state(proto::SimState state) {
        auto snapshot = std::make_shared<server::StatusSnapshot>();
        snapshot->status.state = state;
        snapshot->status.step = 12;
        board.write(std::move(snapshot));
    }

    server::StatusBoard board;
    server::EventLog events;
    server::JobBoard jobs;
    server::ProbeBoard probes;
    std::vector<std::pair<Token, server::Mutation>> mutations;
    std::vector<std::pair<Token, publish::PublisherRequest>> to_publisher;
    std::vector<Json> recorded;
    int shutdowns{0};
    std::vector<Json> replies;
    server::CommandContext context{
        .board = board,
        .events = events,
        .jobs = jobs,
        .probes = probes,
        .hello = {},
        .to_simulation = [this](Token token, server::Mutation m) { mutations.emplace_back(token, std::move(m)); },
        .to_publisher = [this](Token token,
                               publish::PublisherRequest r) { to_publisher.emplace_back(token, std::move(r)); },
        .record_command = [this](const std::string& json, double) { recorded.push_back(Json::parse(json)); },
        .publisher_counts =
            [] {
                return publish::PublisherCounts{
                    1, {proto::StreamState{.stream = "frame/1"}, proto::StreamState{.stream = "data/1"}}};
            },
        .shut_down = [this] { ++shutdowns; },
        .pending = {},
        .waiters = {}};
    server::CommandTable table{[this] { return board.read()->status.state; }, {}};
};

std::string error_name(const Json& reply) {
    return reply.at("error").at("data").at("name");
}

}  // namespace

TEST_CASE("Commands.EveryMethodOfTheProtocolHasAHandler") {
    const Bench bench;
    for (const proto::MethodInfo& info : proto::kMethods) {
        INFO(info.name);
        int count = 0;
        for (const auto& entry : bench.table.entries()) count += entry.info.name == info.name ? 1 : 0;
        CHECK(count == 1);
    }
    CHECK(bench.table.entries().size() == proto::kMethodCount);
}

TEST_CASE("Commands.AMutationIsAnsweredWhenItHasBeenApplied") {
    Bench bench;
    CHECK(bench.ask("objects.remove", {{"name", "panel"}}).is_null());
    REQUIRE(bench.mutations.size() == 1);
    const auto& [token, mutation] = bench.mutations[0];
    CHECK(token != 0);
    CHECK(std::get<proto::ObjectsRemove>(mutation).name == "panel");
    const Json reply = bench.resolve(token, proto::Reply(proto::Applied{40, 0.5}));
    CHECK(reply["result"] == Json::parse(R"({"step":40,"time":0.5})"));
    REQUIRE(bench.recorded.size() == 1);
    CHECK(bench.recorded[0]["method"] == "objects.remove");
    CHECK(bench.recorded[0]["params"]["name"] == "panel");
    CHECK(bench.recorded[0]["step"] == 40);
    // A second outcome for the same token is nobody's.
    bench.context.pending.resolve({token, proto::Reply(proto::Applied{})});
    CHECK(bench.replies.size() == 1);
}

TEST_CASE("Commands.ARefusedMutationIsNotRecorded") {
    Bench bench;
    bench.ask("objects.remove", {{"name", "panel"}});
    const Json reply = bench.resolve(bench.mutations[0].first,
                                     proto::Error{ErrorCode::object_not_found, "no object", "params.name", ""});
    CHECK(error_name(reply) == "object_not_found");
    CHECK(bench.recorded.empty());
}

TEST_CASE("Commands.APresetBecomesADocumentWithTheOverridesInIt") {
    Bench bench;
    bench.ask("scene.load", {{"scene", "dam_break"}, {"parameters", {{"viscosity", 0.25}}}});
    REQUIRE(bench.mutations.size() == 1);
    const auto& load = std::get<proto::SceneLoad>(bench.mutations[0].second);
    const auto& scene = std::get<proto::SceneDesc>(load.scene);
    CHECK(scene.name == "dam_break");
    CHECK(scene.parameters.at("viscosity") == proto::ParameterValue(0.25));
    CHECK(scene.parameters.size() > 1);
    CHECK(load.parameters.empty());

    const Json unknown = bench.ask("scene.load", {{"scene", "dam_brake"}});
    CHECK(error_name(unknown) == "scene_not_found");
    CHECK(unknown["error"]["data"]["hint"] == "did you mean \"dam_break\"?");
    CHECK(bench.mutations.size() == 1);
}

TEST_CASE("Commands.StatusIsAnsweredAtOnceAndWithHashLater") {
    Bench bench;
    bench.set_state(proto::SimState::running);
    const Json now = bench.ask("sim.status");
    CHECK(now["result"]["state"] == "running");
    CHECK(now["result"]["streams"] == 2);
    CHECK(now["result"]["recordings"] == 1);
    CHECK(bench.mutations.empty());

    CHECK(bench.ask("sim.status", {{"hash", true}}).is_null());
    REQUIRE(std::holds_alternative<server::HashWanted>(bench.mutations.at(0).second));
    const Json hashed = bench.resolve(bench.mutations[0].first, proto::Reply(proto::StateHash{"00ff", 13}));
    CHECK(hashed["result"]["state_hash"]["value"] == "00ff");
    CHECK(hashed["result"]["state"] == "running");
}

TEST_CASE("Commands.JobWaitAnswersWhenTheJobHasEnded") {
    Bench bench;
    CHECK(error_name(bench.ask("job.wait", {{"job", 3}})) == "job_not_found");
    proto::JobReply job;
    job.job = 3;
    bench.jobs.write(job);
    CHECK(bench.ask("job.wait", {{"job", 3}}).is_null());
    bench.context.waiters.retry();
    CHECK(bench.replies.empty());
    job.state = proto::JobState::finished;
    bench.jobs.write(job);
    bench.context.waiters.retry();
    REQUIRE(bench.replies.size() == 1);
    CHECK(bench.replies[0]["result"]["state"] == "finished");
    CHECK(bench.context.waiters.size() == 0);
}

TEST_CASE("Commands.WaitersAreAnsweredAtTheirDeadline") {
    Bench bench;
    proto::JobReply job;
    job.job = 3;
    bench.jobs.write(job);
    bench.ask("job.wait", {{"job", 3}, {"timeout", 10}});
    const auto deadline = bench.context.waiters.next_deadline();
    REQUIRE(deadline);
    bench.context.waiters.expire(*deadline - std::chrono::milliseconds(1));
    CHECK(bench.replies.empty());
    bench.context.waiters.expire(*deadline);
    REQUIRE(bench.replies.size() == 1);
    CHECK(error_name(bench.replies[0]) == "timed_out");

    bench.ask("events.since", {{"timeout", 10}});
    bench.context.waiters.expire(*bench.context.waiters.next_deadline());
    CHECK(bench.replies.at(0)["result"]["events"].empty());
    CHECK_FALSE(bench.context.waiters.next_deadline());
}

TEST_CASE("Commands.AnEndingServerRefusesWhoWaits") {
    Bench bench;
    bench.ask("events.since", {{"timeout", 10}});
    bench.context.waiters.refuse_all({ErrorCode::shutting_down, "", "", ""});
    CHECK(error_name(bench.replies.at(0)) == "shutting_down");
    bench.ask("sim.pause");
    bench.context.pending.refuse_all({ErrorCode::shutting_down, "", "", ""});
    CHECK(error_name(bench.replies.at(0)) == "shutting_down");
    CHECK(bench.context.pending.size() == 0);
}

TEST_CASE("Commands.TooManyUnansweredAreRefused") {
    Bench bench;
    for (std::size_t k = 0; k < server::kMaxPendingReplies; ++k) REQUIRE(bench.ask("sim.pause").is_null());
    CHECK(error_name(bench.ask("sim.pause")) == "limit_exceeded");
    CHECK(bench.mutations.size() == server::kMaxPendingReplies);
    bench.context.pending.resolve({bench.mutations[0].first, proto::Reply(proto::Applied{})});
    CHECK(bench.ask("sim.pause").is_null());
}

TEST_CASE("Commands.StreamsAndRecordingsGoToThePublisher") {
    Bench bench;
    bench.set_state(proto::SimState::idle);
    bench.ask("stream.open", {{"mode", "live"}});
    bench.ask("stream.close", {{"stream", "frame/1"}});
    bench.ask("record.start", {{"file", "a.mcap"}});
    bench.ask("record.stop");
    CHECK(bench.to_publisher.size() == 4);
    CHECK(error_name(bench.ask("stream.open", {{"mode", "lossless"}})) == "wrong_socket");
    CHECK(error_name(bench.ask("stream.ack", {{"stream", "data/1"}, {"seq", 1}})) == "wrong_socket");
    bench.set_state(proto::SimState::empty);
    CHECK(error_name(bench.ask("record.start", {{"file", "a.mcap"}})) == "wrong_state");
    CHECK(bench.to_publisher.size() == 4);
}

TEST_CASE("Commands.ShutdownAnswersFirst") {
    Bench bench;
    bench.set_state(proto::SimState::idle);
    CHECK(bench.ask("server.shutdown")["result"]["step"] == 12);
    CHECK(bench.shutdowns == 1);
}

TEST_CASE("Commands.QueriesOfASceneThatIsNotThereYetAreBusy") {
    Bench bench;
    bench.set_state(proto::SimState::loading);
    for (const char* method : {"scene.get", "params.get", "objects.list"}) {
        INFO(method);
        CHECK(error_name(bench.ask(method)) == "busy");
    }
}

namespace {

// A schema as it stands in a document: what it refers to is among the document's components.
Json in_document(Json schema) {
    schema.erase("$defs");
    std::string text = schema.dump();
    const std::string local = "#/$defs/";
    for (std::size_t at = 0; (at = text.find(local, at)) != std::string::npos;)
        text.replace(at, local.size(), "#/components/schemas/");
    return Json::parse(text);
}

}  // namespace

TEST_CASE("Commands.TheDescriptionIsOpenRpcOfTheWholeTable") {
    Bench bench;
    const Json document = bench.ask("describe")["result"];
    CHECK(document["openrpc"] == "1.2.6");
    REQUIRE(document["methods"].size() == proto::kMethodCount);
    for (const Json& method : document["methods"]) {
        INFO(method["name"]);
        const std::string name = method["name"];
        CHECK(method["result"]["schema"] == in_document(proto::method_result_schema(name)));
        const Json properties = in_document(proto::method_params_schema(name))["properties"];
        CHECK(method["examples"].size() == 1);
        REQUIRE(method["params"].size() == properties.size());
        for (const Json& param : method["params"])
            CHECK(param["schema"] == properties[param["name"].get<std::string>()]);
        for (const Json& error : method["errors"]) CHECK(error["code"].is_number_integer());
    }
    CHECK(document["x-models"]["thesis"]["parameters"].size() > 5);
    CHECK(document["x-sockets"].size() == 4);
    CHECK(document["components"]["schemas"].contains("shape"));
    CHECK(document["x-errors"]["names"].size() == proto::kErrors.size());
}
