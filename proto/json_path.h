// Paths into JSON, as errors show them: `params.scene.fluids[0].shape.box.min[1]`. Internal to messages_json.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace headrace::proto {

std::string in_quotes(std::string_view text);

inline bool is_name_character(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
}

// Names that are not plain words stand in brackets and quotes.
inline void append_member(std::string& path, std::string_view name) {
    const bool is_plain = !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
        return (is_name_character(c) && c != '.') || c == '$';
    });
    if (is_plain)
        path.append(path.empty() ? "" : ".").append(name);
    else
        path.append("[").append(in_quotes(name)).append("]");
}

inline void append_index(std::string& path, std::size_t index) {
    path.append("[").append(std::to_string(index)).append("]");
}

}  // namespace headrace::proto
