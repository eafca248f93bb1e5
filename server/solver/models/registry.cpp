#include "server/solver/models/registry.h"

#include <cassert>

#include "server/solver/models/thesis.h"
#include "server/solver/models/thesis_parameters.h"
#include "server/solver/models/wcsph/parameters.h"
#include "server/solver/models/wcsph/wcsph.h"

namespace headrace::solver {
namespace {

struct Entry {
    std::string_view name;
    std::vector<ParameterInfo> (*parameter_table)(int dimensions, double spacing);
    std::unique_ptr<Model> (*make)(int dimensions, double spacing, const ParameterMap& overrides);
};

constexpr Entry kModels[] = {
    {"thesis", thesis_parameter_table, make_thesis},
    {"wcsph", wcsph_parameter_table, make_wcsph},
};

const Entry& find_model(std::string_view name) {
    for (const Entry& entry : kModels) {
        if (entry.name == name) return entry;
    }
    assert(!"name is not one of model_names()");
    return kModels[0];
}

}  // namespace

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for (const Entry& entry : kModels) names.emplace_back(entry.name);
    return names;
}

std::vector<ParameterInfo> model_parameter_table(std::string_view name, int dimensions, double spacing) {
    return find_model(name).parameter_table(dimensions, spacing);
}

std::unique_ptr<Model> make_model(std::string_view name, int dimensions, double spacing,
                                  const ParameterMap& overrides) {
    return find_model(name).make(dimensions, spacing, overrides);
}

}  // namespace headrace::solver
