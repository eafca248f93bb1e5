// The waits of a script.
#pragma once

#include <cstdint>
#include <string>

#include "client/connection.h"
#include "client/script.h"

namespace headrace::client {

// Owner: the script's thread; the connection outlives it.
class ScriptWaits {
  public:
    explicit ScriptWaits(Connection& connection) : connection_(connection) {}

    // Events from here on count. Error: the server's.
    proto::Status begin();

    // With nothing running: a run to that end, as `headrace resume --until`. While a run goes on: until it has come
    // there; it goes on. Errors: the server's; timed_out, cancelled, faulted; wrong_state when the run ends before.
    proto::Status wait(const proto::RunUntil& until, const std::string& label);
    // Until there is an event of the type behind the one that the wait before has found. Errors: the server's,
    // timed_out.
    proto::Status wait(const ScriptEvent& event);

  private:
    proto::Status watch(const proto::JobReply& job, const proto::RunUntil& until);
    // Whether the moment has come; nothing changes.
    proto::Result<bool> is_there(const proto::SimStatusReply& start, const proto::RunUntil& until);
    proto::Result<bool> has_value(const proto::ProbeConditionDesc& condition);
    // The next event of the type, which counts as found then.
    proto::Result<bool> take_event(const std::string& type, double patience);

    Connection& connection_;
    std::uint64_t seen_{0};  // number of the last event found
};

}  // namespace headrace::client
