// Requests that another thread answers: token -> who waits for it.
#pragma once

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

    // Takes the responder over and names it. Nothing (the responder has answered limit_exceeded) when too many wait.
    std::optional<Token> add(Responder& responder, Finish finish = {});

    void resolve(const Outcome& outcome);  // a token that is not known is ignored

    void refuse_all(const proto::Error& error);
    std::size_t size() const { return entries_.size(); }

  private:
    struct Entry {
        Responder responder;
        Finish finish;
    };
    std::unordered_map<Token, Entry> entries_;
    Token last_token_{0};
};

}  // namespace headrace::server
