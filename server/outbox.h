// Outcomes on their way back to the service thread.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "proto/messages.h"
#include "proto/result.h"
#include "server/doorbell.h"

namespace headrace::server {

// Names a request whose reply is still to come. 0: nobody waits.
using Token = std::uint64_t;

struct Outcome {
    Token token{};
    proto::Result<proto::Reply> result;
};

// Filled by the simulation and publisher threads, emptied by the service thread, which sleeps on the doorbell.
class Outbox {
  public:
    void put(Token token, proto::Result<proto::Reply> result);  // any thread; ignored for token 0
    std::vector<Outcome> take();                                // service thread; also quiets the doorbell
    Doorbell& doorbell() { return doorbell_; }

  private:
    std::mutex mutex_;
    std::vector<Outcome> outcomes_;
    Doorbell doorbell_;
};

}  // namespace headrace::server
