// Runs as the client follows them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "client/connection.h"
#include "client/progress.h"
#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::client {

// The share of a run that is done; nothing when it has no known end (at rest, or open). `start`: the job's first reply.
std::optional<double> run_fraction(const proto::RunUntil& until, const proto::JobReply& start, std::uint64_t step,
                                   double time);

// "t 0.84 s, step 84, 567 steps/s"
std::string run_detail(const proto::SimStatusReply& status);

proto::Result<proto::JobReply> start_run(Connection& connection, const proto::RunUntil& until,
                                         std::optional<double> pace = {});

// The job now; `patience` [s] is how long the server may wait for its end.
proto::Result<proto::JobReply> look_at_job(Connection& connection, std::uint64_t job, double patience);

bool has_ended(proto::JobState state);

// One job from its start to its end or a pause, with a progress line.
class JobWatch {
  public:
    JobWatch(Connection& connection, proto::JobReply start, proto::RunUntil until, std::string label);

    // Asks how the job is; waits for its end at most `patience` [s].
    proto::Result<proto::JobReply> look(double patience);
    // Looks until it has ended or is paused.
    proto::Result<proto::JobReply> wait();

  private:
    Connection& connection_;
    proto::JobReply start_;
    proto::RunUntil until_;
    Progress progress_;
};

// "at rest: step 1,234, t 12.34 s", "done: ...", "paused: ...".
std::string job_line(const proto::JobReply& job, const proto::RunUntil& until);

// What an end means for the exit status: nothing for finished or paused; timed_out with the hint given, cancelled, or
// faulted with criterion, particle and remedy.
proto::Status job_verdict(Connection& connection, const proto::JobReply& job, const std::string& timed_out_hint = {});
proto::Error fault_error(const proto::FaultReport& fault);

}  // namespace headrace::client
