// The JSON-RPC 2.0 envelope, for server and client alike: one object per message, no batches. Includes the JSON
// library: for .cpp files that handle requests only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>

#include "proto/messages_json.h"

namespace headrace::proto {

// A request as it came. The id is kept as JSON text ("7", "\"a\"", "null"), so that it is echoed exactly.
struct RpcRequest {
    bool is_notification{false};  // no id: no reply is sent
    std::string id{"null"};
    std::string method;
    Json params;  // an object; {} when absent
};

// What could be read of a request that is refused: the id to answer under, when it was legible.
struct RpcRefusal {
    std::string id{"null"};
    Error error;
};

// Checks limits and envelope (jsonrpc "2.0", id string, integer or null, method a string, params an object, no unknown
// members). Errors: parse_error, json_too_deep, duplicate_key, invalid_request, message_too_large.
std::variant<RpcRequest, RpcRefusal> parse_rpc_request(std::string_view text, std::size_t soft_limit);

std::string rpc_result_text(std::string_view id, const Json& result);
std::string rpc_error_text(std::string_view id, const Error& error);

// Client side.
std::string rpc_request_text(std::int64_t id, std::string_view method, const Json& params);
struct RpcReply {
    std::int64_t id{};  // 0 when the server could not read the request's id
    Result<Json> result;
};
Result<RpcReply> parse_rpc_reply(std::string_view text);

}  // namespace headrace::proto
