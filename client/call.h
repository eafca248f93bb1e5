// Typed requests. Includes the JSON library: for .cpp files only.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "client/connection.h"

namespace headrace::client {

template <class Reply, class Params>
proto::Result<Reply> call(Connection& connection, std::string_view method, const Params& params,
                          Patience patience = Patience::query) {
    auto result = connection.request(method, proto::to_json(params), patience);
    if (!result) return result.error();
    return proto::from_json<Reply>(*result, "result");
}

}  // namespace headrace::client
