// All samples of a probe from a server.
#pragma once

#include <string>

#include "client/connection.h"
#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::client {

// In as many replies as it takes.
proto::Result<proto::ProbeSeries> fetch_series(Connection& connection, const std::string& name);

}  // namespace headrace::client
