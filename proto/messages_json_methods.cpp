// Schemas by method name.
#include <nlohmann/json.hpp>

#include "proto/messages_json.h"
#include "proto/methods.h"

namespace headrace::proto {

namespace {

constexpr std::string_view kDialect = "https://json-schema.org/draft/2020-12/schema";

Json text_schema(std::string_view description) {
    Json schema = Json::object();
    schema["description"] = description;
    schema["type"] = "string";
    return schema;
}

// `describe` answers with a document of a standard that has its own schema; here only what we rely on.
Json open_rpc_schema() {
    Json schema = Json::object();
    schema["$schema"] = kDialect;
    schema["title"] = "OpenRpcDocument";
    schema["type"] = "object";
    schema["properties"]["openrpc"]["type"] = "string";
    schema["properties"]["info"]["type"] = "object";
    schema["properties"]["methods"]["type"] = "array";
    schema["required"] = Json::array({"openrpc", "info", "methods"});
    return schema;
}

template <class Message>
Json schema_of() {
    if constexpr (std::is_same_v<Message, OpenRpcDocument>)
        return open_rpc_schema();
    else
        return json_schema<Message>();
}

template <class Params>
Status check_params_of(const Json& params) {
    const Result<Params> decoded = from_json<Params>(params, "params");
    return decoded ? Status(Done{}) : Status(decoded.error());
}

struct Schemas {
    Json (*params)();
    Json (*result)();
    Status (*check)(const Json& params);
};

template <class Params, class Result>
constexpr Schemas schemas_of(const Method<Params, Result>&) {
    return {&schema_of<Params>, &schema_of<Result>, &check_params_of<Params>};
}

// Beside kMethods, row by row.
const Schemas* find_schemas(std::string_view method) {
    static const std::array<Schemas, kMethodCount> table = std::apply(
        [](const auto&... row) { return std::array<Schemas, kMethodCount>{schemas_of(row)...}; }, kMethodTypes);
    const MethodInfo* info = find_method(method);
    return info ? &table[static_cast<std::size_t>(info - kMethods.data())] : nullptr;
}

}  // namespace

Json error_schema() {
    Json codes = Json::array(), names = Json::array();
    for (const ErrorInfo& info : kErrors) {
        codes.push_back(info.rpc_code);
        names.push_back(info.name);
    }
    Json schema = Json::object();
    schema["$schema"] = kDialect;
    schema["title"] = "Error";
    schema["type"] = "object";
    Json& properties = schema["properties"];
    properties["code"]["enum"] = std::move(codes);
    properties["message"] = text_schema("one sentence for a person");
    Json& data = properties["data"];
    data["type"] = "object";
    data["properties"]["name"]["description"] = "stable name of the error";
    data["properties"]["name"]["enum"] = std::move(names);
    data["properties"]["path"] = text_schema("where: JSON path or file");
    data["properties"]["hint"] = text_schema("the remedy");
    data["properties"]["retryable"]["description"] = "the same request may succeed later";
    data["properties"]["retryable"]["type"] = "boolean";
    data["required"] = Json::array({"name", "retryable"});
    data["additionalProperties"] = false;
    schema["required"] = Json::array({"code", "message", "data"});
    schema["additionalProperties"] = false;
    return schema;
}

Json method_params_schema(std::string_view method) {
    const Schemas* schemas = find_schemas(method);
    return schemas ? schemas->params() : Json();
}

Json method_result_schema(std::string_view method) {
    const Schemas* schemas = find_schemas(method);
    return schemas ? schemas->result() : Json();
}

Status check_params(std::string_view method, const Json& params) {
    const Schemas* schemas = find_schemas(method);
    if (schemas == nullptr)
        return Error{ErrorCode::method_not_found, "there is no method \"" + std::string(method) + "\"", "method", ""};
    return schemas->check(params);
}

}  // namespace headrace::proto
