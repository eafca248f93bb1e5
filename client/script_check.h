// A script's line against what the server says of itself. Includes the JSON library: for .cpp files only.
#pragma once

#include <nlohmann/json.hpp>

#include "client/script.h"
#include "proto/result.h"

namespace headrace::client {

// `description`: the server's `describe`. Names of methods and members are checked by it; values too, where the server
// is of this program's version, by the decoder that it uses itself. Errors as the server would give them:
// method_not_found, wrong_socket, invalid_params.
proto::Status check_step(const ScriptStep& step, const proto::Json& description);

}  // namespace headrace::client
