// Requests that another thread answers: token -> who waits for it.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <unordered_map>

#include "server/outbox.h"
#include "server/service/responder.h"

namespace headrace::server {

// Owner: the service thread.
class PendingReplies {
  public:
    // Turns an outcome into the answer; the default writes the reply struct as it is.
    using Finish = std::function<void(const proto::Result<proto::Reply>&, Responder&)>;

    using Clock = std::chrono::steady_clock;

    // A request that is not to wait for its outcome for longer than `deadline`: `answer` speaks for it then, once; the
    // outcome, when it comes, still goes through the request's Finish, with a responder that is closed.
    struct Early {
        Clock::time_point deadline;
        std::function<void(Responder&)> answer;
    };

    // Takes the responder over and names it. Nothing (the responder has answered limit_exceeded) when too many wait.
    std::optional<Token> add(Responder& responder, Finish finish = {}, std::optional<Early> early = {});

    void resolve(const Outcome& outcome);  // a token that is not known is ignored

    void expire(Clock::time_point now);  // gives the early answers that are due
    std::optional<Clock::time_point> next_deadline() const;

    void refuse_all(const proto::Error& error);
    std::size_t size() const { return entries_.size(); }

  private:
    struct Entry {
        Responder responder;
        Finish finish;
        std::optional<Early> early;
    };
    std::unordered_map<Token, Entry> entries_;
    Token last_token_{0};
};

}  // namespace headrace::server
