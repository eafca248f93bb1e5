#include "client/script_check.h"

#include <algorithm>

#include "proto/suggest.h"
#include "proto/version.h"

namespace headrace::client {

using proto::Json;

namespace {

proto::Result<const Json*> find_method(const std::string& name, const Json& description) {
    std::vector<std::string> known;
    for (const Json& method : description.at("methods")) {
        if (method.at("name") == name) return &method;
        known.push_back(method.at("name").get<std::string>());
    }
    return proto::Error{proto::ErrorCode::method_not_found, "there is no method \"" + name + "\"", "method",
                        proto::suggest(name, known)};
}

proto::Status check_names(const Json& params, const Json& method) {
    std::vector<std::string> known;
    for (const Json& parameter : method.at("params")) {
        const auto name = parameter.at("name").get<std::string>();
        known.push_back(name);
        if (parameter.value("required", false) && !params.contains(name))
            return proto::Error{proto::ErrorCode::invalid_params, "is missing", "params." + name,
                                parameter.value("description", "")};
    }
    for (const auto& [name, value] : params.items())
        if (std::find(known.begin(), known.end(), name) == known.end())
            return proto::Error{proto::ErrorCode::invalid_params, "unknown member", "params." + name,
                                proto::suggest(name, known)};
    return proto::Done{};
}

}  // namespace

proto::Status check_step(const ScriptStep& step, const Json& description) {
    const auto* command = std::get_if<ScriptCommand>(&step.what);
    if (command == nullptr) return proto::Done{};  // waits are this program's own
    auto method = find_method(command->method, description);
    if (!method) return method.error();
    if ((*method)->value("x-socket", "") == "data")
        return proto::Error{proto::ErrorCode::wrong_socket, command->method + " is answered on the data socket",
                            "method",
                            "scripts give commands; frames come by headrace record, or record.start in the script"};
    if (description.at("info").at("version") == proto::kProgramVersion)
        return proto::check_params(command->method, command->params);
    return check_names(command->params, **method);
}

}  // namespace headrace::client
