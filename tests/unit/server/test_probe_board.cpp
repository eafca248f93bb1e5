#include <catch2/catch.hpp>

#include "server/probe_board.h"

using namespace headrace;
using server::ProbeBoard;

namespace {

proto::ProbeDesc desc(const char* name) {
    return {name, proto::FrontProbe{}, {}, {}};
}

proto::ProbeSamples instant(double time, std::vector<proto::ProbeSample> samples) {
    return {time, std::move(samples)};
}

struct Board {
    Board() {
        board.restart(1);
        board.add(desc("a"), {{"front", "m", {}}});
        board.add(desc("b"), {{"front", "m", {}}});
    }
    // Samples a at each time, b at each second one.
    void fill(int count) {
        for (int k = 0; k < count; ++k) {
            std::vector<proto::ProbeSample> samples{{"a", {}, {static_cast<double>(k)}}};
            if (k % 2 == 0) samples.push_back({"b", {}, {std::nullopt}});
            board.append(instant(0.5 * k, std::move(samples)), {});
        }
    }
    ProbeBoard board;
};

}  // namespace

TEST_CASE("ProbeBoard.GivesRowsWithTimeFirstAndNothingWhereThereIsNoValue") {
    Board b;
    CHECK_FALSE(b.board.get({})->complete_to);
    b.fill(3);
    const auto reply = b.board.get({});
    REQUIRE(reply);
    REQUIRE(reply->probes.size() == 2);
    CHECK(reply->probes[0].columns.size() == 2);
    CHECK(reply->probes[0].columns[0].name == "time");
    CHECK(reply->probes[0].rows == std::vector<proto::ProbeRow>{{0.0, 0.0}, {0.5, 1.0}, {1.0, 2.0}});
    CHECK(reply->probes[1].rows == std::vector<proto::ProbeRow>{{0.0, std::nullopt}, {1.0, std::nullopt}});
    CHECK(*reply->complete_to == 1.0);
    CHECK(b.board.list().probes[0].latest == proto::ProbeRow{1.0, 2.0});

    const auto one = b.board.get({"b", 0.0, 10});
    REQUIRE(one->probes.size() == 1);
    CHECK(one->probes[0].rows.size() == 1);
    const auto none = b.board.get({"c", {}, 10});
    CHECK(none.error().code == proto::ErrorCode::probe_not_found);
}

// Asking again and again with complete_to gives every row once, in whatever portions.
TEST_CASE("ProbeBoard.PortionsAddUpToTheWhole") {
    Board b;
    b.fill(11);
    const std::int64_t limit = GENERATE(1, 3, 100);
    INFO("limit " << limit);
    std::vector<proto::ProbeRow> a, other;
    proto::ProbesGet query;
    query.limit = limit;
    for (int turn = 0; turn < 20; ++turn) {
        const auto reply = b.board.get(query);
        a.insert(a.end(), reply->probes[0].rows.begin(), reply->probes[0].rows.end());
        other.insert(other.end(), reply->probes[1].rows.begin(), reply->probes[1].rows.end());
        query.since = reply->complete_to;
    }
    CHECK(a == b.board.get({"a", {}, 100})->probes[0].rows);
    CHECK(a.size() == 11);
    CHECK(other == b.board.get({"b", {}, 100})->probes[0].rows);
}

TEST_CASE("ProbeBoard.DropsTheOldestAndSaysHowMany") {
    ProbeBoard board;
    board.restart(1);
    // So many columns that only 10 samples are kept.
    const std::size_t columns = ProbeBoard::kMostValues / 10 - 1;
    board.add(desc("wide"), std::vector<proto::ProbeColumn>(columns, {"x", "m", {}}));
    for (int k = 0; k < 12; ++k) board.append(instant(k, {{"wide", {}, proto::ProbeRow(columns, 1.0)}}), {});
    CHECK(board.list().probes[0].samples == 10);
    CHECK(board.list().probes[0].dropped == 2);
    // A reply is limited as well: 400,000 values a row leave five rows.
    const auto reply = board.get({});
    REQUIRE(reply->probes[0].rows.size() == ProbeBoard::kMostValuesSent / (columns + 1));
    CHECK(reply->probes[0].rows[0][0] == 2.0);
    CHECK(*reply->complete_to == 6.0);
}

TEST_CASE("ProbeBoard.TellsWhyAProbeCannotBeEvaluated") {
    Board b;
    b.board.append(instant(0, {{"a", {}, {std::nullopt}}}), {{"a", "there is no object"}});
    CHECK(*b.board.list().probes[0].failure == "there is no object");
    b.board.append(instant(1, {{"a", {}, {1.0}}}), {});
    CHECK_FALSE(b.board.list().probes[0].failure);
}

TEST_CASE("ProbeBoard.QueuesForRecordingsFromTheLastInstantOn") {
    Board b;
    CHECK(b.board.begin_queue().number == 0);
    b.board.end_queue();
    b.fill(2);
    CHECK(b.board.take().empty());
    const ProbeBoard::Instant last = b.board.begin_queue();
    CHECK(last.number == 2);
    CHECK(last.generation == 1);
    CHECK(last.samples.time == 0.5);
    REQUIRE(last.samples.samples.size() == 1);
    CHECK(last.samples.samples[0].columns.at(0).unit == "m");
    b.board.append(instant(1.0, {{"a", {}, {7.0}}}), {});
    // Another run begins; what came before it is still to be written.
    b.board.restart(2);
    b.board.add(desc("a"), {{"front", "m", {}}});
    b.board.append(instant(0.0, {{"a", {}, {8.0}}}), {});
    const auto queued = b.board.take();
    REQUIRE(queued.size() == 2);
    CHECK(queued[0].number == 3);
    CHECK(queued[0].generation == 1);
    CHECK(queued[1].generation == 2);
    CHECK(b.board.take().empty());
}
