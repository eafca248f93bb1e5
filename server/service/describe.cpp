// The OpenRPC document, built from the command table, so that it cannot say anything else than what the server does.
#include <limits>
#include <ranges>
#include <string>
#include <string_view>
#include <variant>

#include "proto/envelope.h"
#include "proto/event_types.h"
#include "proto/examples.h"
#include "proto/methods.h"
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

// An object schema as OpenRPC's list of named parameters, of which the required ones come first.
Json params_list(const Json& schema) {
    Json list = Json::array();
    if (!schema.contains("properties")) return list;
    for (const bool wants_required : {true, false})
        for (const auto& [name, property] : schema["properties"].items()) {
            if (is_required(schema, name) != wants_required) continue;
            Json entry{{"name", name}};
            if (property.contains("description")) entry["description"] = property["description"];
            entry["required"] = wants_required;
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

// In a document the schema's own "$defs" are not at hand: they are among the document's components.
void refer_to_components(Json& schema) {
    if (schema.is_object()) schema.erase("$defs");
    for (auto& [key, part] : schema.items()) {
        constexpr std::string_view kLocal = "#/$defs/";
        if (key == "$ref" && part.get_ref<const std::string&>().starts_with(kLocal))
            part = "#/components/schemas/" + part.get<std::string>().substr(kLocal.size());
        else if (part.is_structured())
            refer_to_components(part);
    }
}

// A request and its reply as OpenRPC pairs them.
Json describe_examples(std::string_view method) {
    Json pairings = Json::array();
    for (const proto::Example& example : proto::examples()) {
        if (example.method != method) continue;
        const Json pair = Json::parse(example.json);
        Json params = Json::array();
        for (const auto& [name, value] : pair["request"]["params"].items())
            params.push_back({{"name", name}, {"value", value}});
        pairings.push_back({{"name", method},
                            {"params", std::move(params)},
                            {"result", {{"name", "result"}, {"value", pair["reply"]["result"]}}}});
    }
    return pairings;
}

Json describe_method(const CommandTable::Entry& entry) {
    Json params = proto::method_params_schema(entry.info.name);
    Json result = proto::method_result_schema(entry.info.name);
    refer_to_components(params);
    refer_to_components(result);
    Json errors = Json::array();
    for (ErrorCode code : kCommonErrors) errors.push_back(error_entry(code));
    for (ErrorCode code : entry.rules.errors) errors.push_back(error_entry(code));
    if (entry.info.socket == proto::MethodSocket::control) errors.push_back(error_entry(ErrorCode::wrong_socket));
    return {{"name", entry.info.name},
            {"summary", entry.info.summary},
            {"paramStructure", "by-name"},
            {"params", params_list(params)},
            {"result", {{"name", "result"}, {"schema", std::move(result)}}},
            {"errors", std::move(errors)},
            {"examples", describe_examples(entry.info.name)},
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

Json describe_events() {
    Json topics = Json::array();
    for (const proto::EventTypeInfo& info : proto::kEventTypes) {
        Json data = Json::array();
        for (const auto name : std::views::split(info.data, ','))
            data.push_back(std::string_view(name.begin(), name.end()));
        topics.push_back({{"type", info.type},
                          {"topic", info.type.substr(0, info.type.find('.'))},
                          {"when", info.when},
                          {"data", std::move(data)},
                          {"objects", info.has_objects}});
    }
    Json schema = proto::json_schema<proto::Event>();
    refer_to_components(schema);
    return {{"schema", std::move(schema)}, {"types", std::move(topics)}};
}

Json describe_errors() {
    Json errors = Json::array();
    for (const proto::ErrorInfo& info : proto::kErrors)
        errors.push_back({{"name", info.name},
                          {"code", info.rpc_code},
                          {"retryable", info.retryable},
                          {"exit_status", info.exit_code},
                          {"meaning", info.meaning}});
    return {{"schema", proto::error_schema()}, {"names", std::move(errors)}};
}

// Parts that schemas refer to.
Json describe_components() {
    Json schemas = Json::object();
    const auto collect = [&](const Json& schema) {
        if (const auto found = schema.find("$defs"); found != schema.end()) schemas.update(*found);
    };
    for (const proto::MethodInfo& info : proto::kMethods) {
        collect(proto::method_params_schema(info.name));
        collect(proto::method_result_schema(info.name));
    }
    refer_to_components(schemas);
    return {{"schemas", std::move(schemas)}};
}

}  // namespace

Json make_description(const CommandTable& table) {
    Json methods = Json::array();
    for (const CommandTable::Entry& entry : table.entries()) methods.push_back(describe_method(entry));
    return {{"openrpc", "1.2.6"},
            {"info",
             {{"title", "headraced"},
              {"version", proto::kProgramVersion},
              {"description", "A fluid simulation that is commanded while it runs. SI units throughout."}}},
            {"methods", std::move(methods)},
            {"components", describe_components()},
            {"x-protocol", proto::kProtocolVersion},
            {"x-sockets", describe_sockets()},
            {"x-events", describe_events()},
            {"x-errors", describe_errors()},
            {"x-state", describe_states()},
            {"x-models", describe_models()}};
}

}  // namespace headrace::server
