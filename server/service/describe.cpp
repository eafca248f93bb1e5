// The OpenRPC document, built from the command table, so that it cannot say anything else than what the server does.
#include <limits>
#include <string>
#include <string_view>
#include <variant>

#include "proto/envelope.h"
#include "proto/version.h"
#include "server/service/commands.h"
#include "server/solver/models/registry.h"
#include "server/state_table.h"

namespace headrace::server {

using proto::ErrorCode;
using proto::Json;

namespace {

Json error_entry(ErrorCode code) {
    const proto::ErrorInfo& info = proto::error_info(code);
    return {{"code", info.rpc_code},
            {"message", info.name},
            {"data", {{"name", info.name}, {"retryable", info.retryable}}}};
}

// Errors that every method may give.
constexpr ErrorCode kCommonErrors[] = {
    ErrorCode::parse_error,   ErrorCode::invalid_request, ErrorCode::invalid_params,    ErrorCode::internal_error,
    ErrorCode::json_too_deep, ErrorCode::duplicate_key,   ErrorCode::message_too_large, ErrorCode::shutting_down};

bool is_required(const Json& schema, std::string_view member) {
    if (!schema.contains("required")) return false;
    for (const Json& name : schema["required"])
        if (name == member) return true;
    return false;
}

// An object schema as OpenRPC's list of named parameters.
Json params_list(const Json& schema) {
    Json list = Json::array();
    if (!schema.contains("properties")) return list;
    for (const auto& [name, property] : schema["properties"].items()) {
        Json entry{{"name", name}};
        if (property.contains("description")) entry["description"] = property["description"];
        entry["required"] = is_required(schema, name);
        entry["schema"] = property;
        list.push_back(std::move(entry));
    }
    return list;
}

std::string_view socket_name(proto::MethodSocket socket) {
    switch (socket) {
        case proto::MethodSocket::control:
            return "control";
        case proto::MethodSocket::data:
            return "data";
        case proto::MethodSocket::both:
            return "control or data";
    }
    return "control";
}

Json describe_method(const CommandTable::Entry& entry) {
    const Json params = proto::method_params_schema(entry.info.name);
    Json errors = Json::array();
    for (ErrorCode code : kCommonErrors) errors.push_back(error_entry(code));
    for (ErrorCode code : entry.rules.errors) errors.push_back(error_entry(code));
    return {{"name", entry.info.name},
            {"summary", entry.info.summary},
            {"paramStructure", "by-name"},
            {"params", params_list(params)},
            {"result", {{"name", "result"}, {"schema", proto::method_result_schema(entry.info.name)}}},
            {"errors", std::move(errors)},
            {"x-socket", socket_name(entry.info.socket)},
            {"x-params-schema", params}};
}

Json describe_sockets() {
    return {{"control", "ROUTER; DEALER or REQ connects; JSON-RPC 2.0, one request object a message, no batches"},
            {"events", "XPUB; SUB connects; topic (16 bytes, NUL-padded) and one event as JSON"},
            {"frames", "XPUB; SUB connects; a live stream's id is its topic; one frame a message, lossy"},
            {"data", "ROUTER; DEALER connects; frame.get, lossless stream.open, stream.ack, stream.close"}};
}

Json describe_states() {
    Json table = Json::array();
    for (const StateRule& rule : kStateTable)
        table.push_back({{"method", rule.method},
                         {"empty", rule.empty},
                         {"loading", rule.loading},
                         {"idle", rule.idle},
                         {"running", rule.running},
                         {"faulted", rule.faulted}});
    return table;
}

// Lengths follow the spacing, so defaults are told for one: the thesis' own in 3D [m].
constexpr double kExampleSpacing = 0.027;

Json value_json(const solver::ParameterValue& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
}

Json describe_parameter(const solver::ParameterInfo& info) {
    Json entry{{"name", info.name}, {"unit", info.unit}, {"meaning", info.meaning}};
    entry["default"] = value_json(info.default_value);
    if (info.min > -std::numeric_limits<double>::infinity())
        entry[info.min_is_exclusive ? "exclusive_minimum" : "minimum"] = info.min;
    if (info.max < std::numeric_limits<double>::infinity()) entry["maximum"] = info.max;
    if (!info.choices.empty()) entry["choices"] = info.choices;
    return entry;
}

Json describe_models() {
    Json models = Json::object();
    for (const std::string& name : solver::model_names()) {
        Json parameters = Json::array();
        for (const solver::ParameterInfo& info : solver::model_parameter_table(name, 3, kExampleSpacing))
            parameters.push_back(describe_parameter(info));
        models[name] = {
            {"defaults_for", {{"dimensions", 3}, {"spacing", kExampleSpacing}}},
            {"parameters", std::move(parameters)},
        };
    }
    return models;
}

// Schemas refer to "#/$defs/...": in the document they stand in, that is its own root.
void collect_definitions(const Json& methods, Json& definitions) {
    for (const Json& method : methods)
        for (const Json* schema : {&method["x-params-schema"], &method["result"]["schema"]})
            if (const auto found = schema->find("$defs"); found != schema->end()) definitions.update(*found);
}

}  // namespace

Json make_description(const CommandTable& table) {
    Json methods = Json::array();
    for (const CommandTable::Entry& entry : table.entries()) methods.push_back(describe_method(entry));
    Json definitions = Json::object();
    collect_definitions(methods, definitions);
    return {{"openrpc", "1.2.6"},
            {"info",
             {{"title", "headraced"},
              {"version", proto::kProgramVersion},
              {"description", "A fluid simulation that is commanded while it runs. SI units throughout."}}},
            {"methods", std::move(methods)},
            {"$defs", std::move(definitions)},
            {"x-protocol", proto::kProtocolVersion},
            {"x-sockets", describe_sockets()},
            {"x-state", describe_states()},
            {"x-models", describe_models()}};
}

}  // namespace headrace::server
