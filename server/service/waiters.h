// Requests that wait for something to happen: job.wait and the long poll of events.since.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "server/service/responder.h"

namespace headrace::server {

// Owner: the service thread.
class Waiters {
  public:
    using Clock = std::chrono::steady_clock;

    // Answers the responder when it can. `is_late`: the deadline has passed, the last chance to answer.
    using Attempt = std::function<void(Responder&, bool is_late)>;

    // Tries at once; keeps the responder when that gave no answer. No deadline: waits as long as the server lives.
    void add(Responder& responder, std::optional<Clock::time_point> deadline, Attempt attempt);

    void retry();                        // something has happened
    void expire(Clock::time_point now);  // answers those whose deadline has passed
    std::optional<Clock::time_point> next_deadline() const;

    void refuse_all(const proto::Error& error);
    std::size_t size() const { return waiters_.size(); }

  private:
    struct Waiter {
        Responder responder;
        std::optional<Clock::time_point> deadline;
        Attempt attempt;
    };
    static void try_once(Waiter& waiter, bool is_late);
    void forget_answered();

    std::vector<std::unique_ptr<Waiter>> waiters_;
};

}  // namespace headrace::server
