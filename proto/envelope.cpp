#include "proto/envelope.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "proto/json_visitors.h"
#include "proto/suggest.h"

namespace headrace::proto {

namespace {

Error invalid(std::string message, std::string path, std::string hint) {
    return {ErrorCode::invalid_request, std::move(message), std::move(path), std::move(hint)};
}

bool is_id(const Json& json) {
    return json.is_string() || json.is_number_integer() || json.is_null();
}

// The first offence of an envelope whose id is already known to be sound.
std::optional<Error> check_envelope(const Json& json) {
    const auto version = json.find("jsonrpc");
    if (version == json.end()) return invalid("jsonrpc is missing", "jsonrpc", "add \"jsonrpc\": \"2.0\"");
    if (*version != "2.0") return invalid("must be \"2.0\"", "jsonrpc", "this server speaks JSON-RPC 2.0");
    const auto method = json.find("method");
    if (method == json.end()) return invalid("method is missing", "method", "try the method hello or describe");
    if (!method->is_string()) return invalid("must be a string", "method", "try the method hello or describe");
    if (const auto params = json.find("params"); params != json.end() && !params->is_object())
        return invalid("must be an object", "params", "give parameters by name: {\"name\": value}");
    static const std::vector<std::string> known{"jsonrpc", "id", "method", "params"};
    for (const auto& [name, value] : json.items())
        if (std::find(known.begin(), known.end(), name) == known.end())
            return invalid("unknown member " + in_quotes(name), name.size() <= kMaxNameLength ? name : std::string(),
                           suggest(name, known));
    return std::nullopt;
}

std::string envelope_text(std::string_view id, const char* member, const Json& json) {
    std::string text = "{\"jsonrpc\":\"2.0\",\"id\":";
    return text.append(id).append(",\"").append(member).append("\":").append(json_text(json)).append("}");
}

}  // namespace

std::variant<RpcRequest, RpcRefusal> parse_rpc_request(std::string_view text, std::size_t soft_limit) {
    if (text.size() > soft_limit)
        return RpcRefusal{
            "null",
            {ErrorCode::message_too_large,
             "the message has " + std::to_string(text.size()) + " bytes, the limit is " + std::to_string(soft_limit),
             {},
             "send less at a time"}};
    Result<Json> parsed = parse_json(text);
    if (!parsed) return RpcRefusal{"null", parsed.error()};
    Json& json = *parsed;
    if (json.is_array()) return RpcRefusal{"null", invalid("batches are not taken", {}, "send one object per message")};
    if (!json.is_object()) return RpcRefusal{"null", invalid("must be an object", {}, "send a JSON-RPC 2.0 request")};

    RpcRequest request;
    if (const auto id = json.find("id"); id == json.end()) {
        request.is_notification = true;
    } else if (is_id(*id)) {
        request.id = json_text(*id);
    } else {
        return RpcRefusal{"null",
                          invalid("must be a string, an integer or null", "id", "count your requests: 1, 2, 3")};
    }
    if (std::optional<Error> error = check_envelope(json)) return RpcRefusal{request.id, *error};
    request.method = json["method"].get<std::string>();
    const auto params = json.find("params");
    request.params = params == json.end() ? Json::object() : std::move(*params);
    return request;
}

std::string rpc_result_text(std::string_view id, const Json& result) {
    return envelope_text(id, "result", result);
}

std::string rpc_error_text(std::string_view id, const Error& error) {
    return envelope_text(id, "error", error_json(error));
}

std::string rpc_request_text(std::int64_t id, std::string_view method, const Json& params) {
    Json json = Json::object();
    json["jsonrpc"] = "2.0";
    json["id"] = id;
    json["method"] = method;
    json["params"] = params;
    return json_text(json);
}

// Members that a newer server may add are passed over.
Result<RpcReply> parse_rpc_reply(std::string_view text) {
    Result<Json> parsed = parse_json(text);
    if (!parsed) return parsed.error();
    Json& json = *parsed;
    if (!json.is_object() || json.find("jsonrpc") == json.end() || json["jsonrpc"] != "2.0")
        return invalid("the reply is no JSON-RPC 2.0 object", {}, {});
    const auto id = json.find("id");
    const bool is_error = json.contains("error");
    if (id == json.end() || !(id->is_number_integer() || (is_error && id->is_null())))
        return invalid("the reply's id must be an integer", "id", {});
    if (is_error == json.contains("result")) return invalid("the reply needs either a result or an error", {}, {});
    const std::int64_t number = id->is_null() ? 0 : id->get<std::int64_t>();
    if (is_error) return RpcReply{number, error_from_json(json["error"])};
    return RpcReply{number, std::move(json["result"])};
}

}  // namespace headrace::proto
