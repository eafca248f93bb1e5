// A recorder and a run side by side.
#pragma once

#include <optional>
#include <string>

#include "client/connection.h"
#include "client/record.h"
#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::client {

// Follows a job until it has ended, with a progress line; on Ctrl-C returns the job as it is. `recorder` takes in
// frames meanwhile; null: somebody else records.
proto::Result<proto::JobReply> follow_job(Connection& connection, Recorder* recorder, const proto::JobReply& start,
                                          const proto::RunUntil& until, const std::string& label);

// Follows what others run: until the run ends (waiting for one to start if none is under way), for so much simulated
// time, or until Ctrl-C.
proto::Result<proto::JobReply> follow_others(Connection& connection, Recorder* recorder,
                                             const proto::SimStatusReply& before, std::optional<double> for_seconds,
                                             const std::string& label);

// Ends the recording whatever happened, and says which failure counts: that of the run, or else that of the file.
proto::Status end_recording(Recorder& recorder, const proto::Status& outcome);

}  // namespace headrace::client
