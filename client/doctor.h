// Is this machine in order for headrace? What `headrace doctor` looks at.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proto/result.h"

namespace headrace::client {

enum class Health { good, warning, failure };

struct Finding {
    std::string subject;  // what was looked at
    Health health{Health::good};
    std::string found;
    std::string remedy;                                       // what to do; empty when it is good
    proto::ErrorCode code{proto::ErrorCode::internal_error};  // of a failure: gives the exit status
};

// Looks at everything, which takes a few seconds at most: a private server is started and ended. `server`: --server.
std::vector<Finding> examine(const std::string& server);

}  // namespace headrace::client
