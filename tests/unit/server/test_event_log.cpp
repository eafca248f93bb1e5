#include <catch2/catch.hpp>
#include <thread>

#include "server/event_log.h"

using namespace headrace;

namespace {

proto::Event event(const std::string& type) {
    proto::Event made;
    made.type = type;
    return made;
}

}  // namespace

TEST_CASE("EventLog.NumbersAreGapFreeFromOneWhoeverAdds") {
    server::EventLog log;
    std::vector<std::thread> writers;
    for (int k = 0; k < 4; ++k)
        writers.emplace_back([&] {
            for (int n = 0; n < 250; ++n) log.add(event("a"));
        });
    for (auto& writer : writers) writer.join();
    const auto all = log.since({0, 0.0, {}, 10'000});
    REQUIRE(all.events.size() == 1'000);
    for (std::size_t k = 0; k < all.events.size(); ++k) CHECK(all.events[k].seq == k + 1);
}

TEST_CASE("EventLog.SinceGivesWhatCameAfterAndWhereToGoOn") {
    server::EventLog log;
    for (const char* type : {"a", "b", "a", "b"}) log.add(event(type));
    CHECK(log.since({2, 0.0, {}, 100}).events.size() == 2);
    const auto only_a = log.since({0, 0.0, {"a"}, 100});
    REQUIRE(only_a.events.size() == 2);
    CHECK(only_a.last_seq == 4);
    const auto first = log.since({0, 0.0, {}, 3});
    CHECK(first.events.size() == 3);
    CHECK(first.last_seq == 3);
    CHECK(log.since({4, 0.0, {}, 100}).events.empty());
    CHECK(log.since({99, 0.0, {}, 100}).events.empty());
}

TEST_CASE("EventLog.ForgottenEventsAreCountedAsLost") {
    server::EventLog log;
    for (std::size_t k = 0; k < server::EventLog::kCapacity + 5; ++k) log.add(event("a"));
    const auto reply = log.since({0, 0.0, {}, 10});
    CHECK(reply.lost == 5);
    CHECK(reply.events.front().seq == 6);
    CHECK(log.since({3, 0.0, {}, 10}).lost == 2);
    CHECK(log.since({5, 0.0, {}, 10}).lost == 0);
}
