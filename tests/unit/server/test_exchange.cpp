#include <poll.h>

#include <catch2/catch.hpp>
#include <thread>

#include "server/inbox.h"
#include "server/jobs.h"
#include "server/outbox.h"

using namespace headrace;

namespace {

bool rings(const server::Doorbell& bell) {
    pollfd item{bell.fd(), POLLIN, 0};
    return ::poll(&item, 1, 0) == 1;
}

}  // namespace

TEST_CASE("Inbox.KeepsTheOrderOfItsItems") {
    server::Inbox inbox;
    for (server::Token token = 1; token <= 3; ++token) inbox.put(token, proto::SimPause{});
    for (server::Token token = 1; token <= 3; ++token) CHECK(inbox.take()->token == token);
    CHECK_FALSE(inbox.take().has_value());
}

TEST_CASE("Inbox.AWakeBeforeTheWaitIsNotLost") {
    server::Inbox inbox;
    inbox.wake();
    inbox.wait();  // would never return if it were
    std::thread other([&] { inbox.put(5, proto::SimPause{}); });
    inbox.wait();
    other.join();
    CHECK(inbox.take()->token == 5);
}

TEST_CASE("Outbox.RingsOnceThereIsAnOutcomeAndIgnoresTokenZero") {
    server::Outbox outbox;
    outbox.put(0, proto::Reply(proto::Applied{}));
    CHECK_FALSE(rings(outbox.doorbell()));
    outbox.put(4, proto::Reply(proto::Applied{9, 0.5}));
    CHECK(rings(outbox.doorbell()));
    const auto outcomes = outbox.take();
    REQUIRE(outcomes.size() == 1);
    CHECK(outcomes[0].token == 4);
    CHECK(std::get<proto::Applied>(*outcomes[0].result).step == 9);
    CHECK_FALSE(rings(outbox.doorbell()));
}

TEST_CASE("JobBoard.RemembersTheLastWordOfEachJob") {
    server::JobBoard board;
    proto::JobReply job;
    for (std::uint64_t number = 1; number <= server::JobBoard::kCapacity + 1; ++number) {
        job.job = number;
        job.state = number == 3 ? proto::JobState::paused : proto::JobState::finished;
        board.write(job);
    }
    CHECK_FALSE(board.find(1).has_value());
    CHECK_FALSE(board.find(server::JobBoard::kCapacity + 2).has_value());
    job.job = 7;
    job.state = proto::JobState::cancelled;
    board.write(job);
    CHECK(board.find(7)->state == proto::JobState::cancelled);
    CHECK(board.find(8)->state == proto::JobState::finished);
    // However many jobs follow, one that is paused is not forgotten.
    for (std::uint64_t number = 2'000; number < 4'000; ++number) {
        job.job = number;
        job.state = proto::JobState::finished;
        board.write(job);
    }
    CHECK(board.find(3)->state == proto::JobState::paused);
    CHECK_FALSE(board.find(8).has_value());
}
