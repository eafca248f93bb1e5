// Name -> model: the single list.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/solver/model.h"

namespace headrace::solver {

std::vector<std::string> model_names();

// Defaults depend on the scene: lengths follow the spacing. Precondition: name is one of model_names().
std::vector<ParameterInfo> model_parameter_table(std::string_view name, int dimensions, double spacing);

// Precondition: name is one of model_names() and check_parameters() accepts the overrides.
std::unique_ptr<Model> make_model(std::string_view name, int dimensions, double spacing, const ParameterMap& overrides);

}  // namespace headrace::solver
