// The samples of the server's probes on their way into a recording of the client's.
#pragma once

#include <string>

#include "client/connection.h"
#include "proto/recording.h"
#include "proto/result.h"

namespace headrace::client {

class ProbeRecording {
  public:
    // `from` [s]: when the recording begins; what is sampled at that moment belongs to it. Both outlive this.
    ProbeRecording(Connection& connection, proto::RecordingWriter& writer, double from);

    // Asks for what has come since, and writes it up to `end` [s]. A server without probes has nothing to give.
    proto::Status take(double end);

  private:
    Connection& connection_;
    proto::RecordingWriter& writer_;
    double since_;  // [s] written so far
    bool has_probes_{true};
};

}  // namespace headrace::client
