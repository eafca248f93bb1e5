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
    // Until an event of the type comes that no earlier wait has seen. Errors: the server's, timed_out.
    proto::Status wait(const ScriptEvent& event);

  private:
    proto::Status watch(const proto::JobReply& job, const proto::RunUntil& until);
    // Whether the moment has come; nothing changes.
    proto::Result<bool> is_there(const proto::SimStatusReply& start, const proto::RunUntil& until);
    proto::Result<bool> has_value(const proto::ProbeConditionDesc& condition);
    // The events of the type since the last look; those before the first one found are seen then.
    proto::Result<bool> take_event(const std::string& type, double patience);

    Connection& connection_;
    std::uint64_t seen_{0};
};

}  // namespace headrace::client
