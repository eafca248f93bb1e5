// Collision objects in POV-Ray's language: containers are glass, obstacles solid, planes sheets.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "client/writers/placed_object.h"
#include "client/writers/stage.h"

namespace headrace::client {

// Their materials, declared before them.
std::string_view pov_object_looks();

// As `camera` sees them: glass before the fluid is clearer than glass behind it.
std::string pov_objects(const std::vector<PlacedObject>& objects, const proto::SceneDesc& scene, const Stage& stage,
                        const Camera& camera);

}  // namespace headrace::client
