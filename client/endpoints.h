// Where the sockets of a server are, seen from this side.
#pragma once

#include <string>

#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::client {

inline constexpr const char* kDefaultEndpoint = "tcp://127.0.0.1:5755";

// The data socket: on tcp the client's own host with the port that hello gave (the server may be behind a tunnel and
// does not know by which name it is reached), on ipc the endpoint that hello gave. Error: connection_failed.
proto::Result<std::string> data_endpoint(const std::string& control, const proto::HelloReply& hello);

// --server, else HEADRACE_SERVER, else kDefaultEndpoint.
std::string control_endpoint(const std::string& option);

// Whether the user chose a server at all.
bool is_server_chosen(const std::string& option);

}  // namespace headrace::client
