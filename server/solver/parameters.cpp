#include "server/solver/parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace headrace::solver {
namespace {

std::string to_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string with_unit(double value, const std::string& unit) {
    return unit == "1" ? to_text(value) : to_text(value) + " " + unit;
}

const char* kind_of(const ParameterValue& value) {
    constexpr const char* kKinds[] = {"a number", "true or false", "a string", "a vector of three numbers"};
    return kKinds[value.index()];
}

// What a number violates; empty when admissible.
std::string find_violation(const ParameterInfo& info, double value) {
    if (!std::isfinite(value)) return "must be finite";
    const std::string got = ", got " + to_text(value);
    if (info.min_is_exclusive ? value <= info.min : value < info.min) {
        return (info.min_is_exclusive ? "must be greater than " : "must be at least ") +
               with_unit(info.min, info.unit) + got;
    }
    if (value > info.max) return "must be at most " + with_unit(info.max, info.unit) + got;
    return {};
}

std::string find_violation(const ParameterInfo& info, const ParameterValue& value) {
    if (value.index() != info.default_value.index()) {
        return std::string("must be ") + kind_of(info.default_value) + ", got " + kind_of(value);
    }
    if (const double* number = std::get_if<double>(&value)) return find_violation(info, *number);
    if (const Vec3* vector = std::get_if<Vec3>(&value)) {
        for (const double component : *vector) {
            if (const std::string violation = find_violation(info, component); !violation.empty()) {
                return "each component " + violation;
            }
        }
    }
    if (const std::string* choice = std::get_if<std::string>(&value)) {
        if (std::find(info.choices.begin(), info.choices.end(), *choice) != info.choices.end()) return {};
        std::string message = "must be one of";
        for (const std::string& admissible : info.choices) message += " \"" + admissible + "\"";
        return message + ", got \"" + *choice + "\"";
    }
    return {};
}

}  // namespace

std::optional<ParameterError> check_parameters(const std::vector<ParameterInfo>& table, const ParameterMap& values) {
    for (const auto& [name, value] : values) {
        const auto info = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.name == name; });
        if (info == table.end()) {
            std::string known;
            for (const ParameterInfo& row : table) known += (known.empty() ? "" : ", ") + row.name;
            return ParameterError{name, true, "no such parameter", "known: " + known};
        }
        if (std::string violation = find_violation(*info, value); !violation.empty()) {
            return ParameterError{name, false, std::move(violation), info->name + ": " + info->meaning};
        }
    }
    return std::nullopt;
}

}  // namespace headrace::solver
