// An example of each method, request and reply, as JSON text: those of proto/schemas.
#pragma once

#include <span>
#include <string_view>

namespace headrace::proto {

struct Example {
    std::string_view method;
    std::string_view json;  // {"request": {...}, "reply": {...}}
};

std::span<const Example> examples();

}  // namespace headrace::proto
