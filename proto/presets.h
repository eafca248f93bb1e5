// The scenes that come with the program, as JSON text.
#pragma once

#include <span>
#include <string_view>

namespace headrace::proto {

struct Preset {
    std::string_view name;
    std::string_view json;  // a scene document
};

std::span<const Preset> presets();

}  // namespace headrace::proto
