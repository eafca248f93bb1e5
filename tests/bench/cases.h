// What is timed: presets, at their own or a finer spacing.
#pragma once

#include <string>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"

namespace headrace::bench {

struct Case {
    std::string label;  // "dam_break", "dam_break/2"
    proto::SceneDesc scene;
};

// `refine` divides the preset's spacing. Parameters whose default follows the spacing (support, mass, time step) are
// then left to their defaults, since the preset's own values belong to its own spacing. Objects named in `removed` are
// left out: behind its panel a dam break would be timed at rest.
proto::Result<Case> make_case(const std::string& preset, double refine, const std::vector<std::string>& removed);

}  // namespace headrace::bench
