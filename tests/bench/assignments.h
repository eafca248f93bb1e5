// Parameters of a model as options of the command line give them: name=value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proto/scene_desc.h"

namespace headrace::bench {

// Adds them to `parameters`; says what is wrong with one that is none.
std::optional<std::string> take_assignments(const std::vector<std::string>& assignments, proto::Parameters& parameters);

}  // namespace headrace::bench
