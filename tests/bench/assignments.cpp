#include "tests/bench/assignments.h"

#include <cstdlib>
#include <sstream>

namespace headrace::bench {

namespace {

// "true", "0.05", "0,-9.81" or a word.
proto::ParameterValue parse_value(const std::string& text) {
    if (text == "true" || text == "false") return text == "true";
    proto::Vec3 numbers{};
    std::istringstream cells(text);
    std::string cell;
    std::size_t count = 0;
    while (std::getline(cells, cell, ',')) {
        char* end{};
        const double number = std::strtod(cell.c_str(), &end);
        if (end == cell.c_str() || *end != '\0' || count == numbers.size()) return text;
        numbers[count++] = number;
    }
    if (count == 1) return numbers[0];
    return numbers;
}

}  // namespace

std::optional<std::string> take_assignments(const std::vector<std::string>& assignments,
                                            proto::Parameters& parameters) {
    for (const std::string& assignment : assignments) {
        const auto split = assignment.find('=');
        if (split == std::string::npos) return "--set needs name=value, got " + assignment;
        parameters[assignment.substr(0, split)] = parse_value(assignment.substr(split + 1));
    }
    return std::nullopt;
}

}  // namespace headrace::bench
