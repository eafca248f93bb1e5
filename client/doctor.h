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

inline Finding good(std::string subject, std::string found) {
    return {std::move(subject), Health::good, std::move(found), ""};
}
inline Finding warning(std::string subject, std::string found, std::string remedy) {
    return {std::move(subject), Health::warning, std::move(found), std::move(remedy)};
}

// Looks at everything, which takes a few seconds at most: a private server is started and ended. `server`: --server.
std::vector<Finding> examine(const std::string& server);

}  // namespace headrace::client
