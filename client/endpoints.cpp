#include "client/endpoints.h"

#include <cstdlib>

namespace headrace::client {

proto::Result<std::string> data_endpoint(const std::string& control, const proto::HelloReply& hello) {
    if (hello.data_endpoint) return *hello.data_endpoint;
    const std::size_t colon = control.rfind(':');
    if (hello.data_port && control.starts_with("tcp://") && colon > 5)
        return control.substr(0, colon + 1) + std::to_string(*hello.data_port);
    return proto::Error{proto::ErrorCode::connection_failed, "the server names no data socket", control,
                        "give its control endpoint as --server tcp://HOST:PORT"};
}

std::string control_endpoint(const std::string& option) {
    if (!option.empty()) return option;
    const char* variable = std::getenv("HEADRACE_SERVER");
    return variable != nullptr && *variable != '\0' ? variable : kDefaultEndpoint;
}

bool is_server_chosen(const std::string& option) {
    const char* variable = std::getenv("HEADRACE_SERVER");
    return !option.empty() || (variable != nullptr && *variable != '\0');
}

}  // namespace headrace::client
