// The parameters of a model as a table: name, unit, kind, default, admissible range. `params.get`, `params.set`, the
// scene document and `describe` all read it.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "server/solver/particles.h"

namespace headrace::solver {

using ParameterValue = std::variant<double, bool, std::string, Vec3>;
using ParameterMap = std::map<std::string, ParameterValue>;

struct ParameterInfo {
    std::string name;
    std::string unit;     // "1" when it has none
    std::string meaning;  // one sentence, with the equation it enters
    ParameterValue default_value;
    double min{-std::numeric_limits<double>::infinity()};  // for numbers (each component of a vector)
    double max{std::numeric_limits<double>::infinity()};
    bool min_is_exclusive{false};        // true: must be greater than min
    std::vector<std::string> choices{};  // for strings
};

// Why a set of parameters was refused.
struct ParameterError {
    std::string name;     // of the parameter
    bool unknown{false};  // no such parameter
    std::string message;  // "must be greater than 0 s, got -0.01"
    std::string hint;
};

// Checks kind, range, choice and finiteness of each value against the table; the first that fails is returned.
std::optional<ParameterError> check_parameters(const std::vector<ParameterInfo>& table, const ParameterMap& values);

}  // namespace headrace::solver
