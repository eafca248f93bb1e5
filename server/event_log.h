// What has happened, numbered: the memory behind `events.since` and the source of the events socket.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include "proto/messages.h"
#include "server/doorbell.h"

namespace headrace::server {

class EventLog {
  public:
    static constexpr std::size_t kCapacity = 10'000;  // older events are forgotten, and counted as lost
    static constexpr std::size_t kObjectLists = 100;  // events that keep their list of objects: it may be long

    // The listeners' doorbells ring at each event; they outlive the log.
    void add_listener(Doorbell& doorbell);

    // Numbers the event, stamps the wall clock, stores it. Any thread. Returns its number.
    std::uint64_t add(proto::Event event);

    // Events with seq > since, oldest first, at most `limit`, filtered by type when `types` is not empty. `last_seq` is
    // the number up to which the answer is complete.
    proto::EventsSinceReply since(const proto::EventsSince& query) const;

    std::uint64_t last_seq() const;

  private:
    mutable std::mutex mutex_;
    std::deque<proto::Event> events_;
    std::deque<std::uint64_t> with_objects_;  // numbers of the events that have a list of objects
    std::uint64_t last_seq_{0};
    std::vector<Doorbell*> listeners_;
};

}  // namespace headrace::server
