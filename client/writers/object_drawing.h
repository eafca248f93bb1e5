// Collision objects in a picture: containers as thin glass, obstacles as translucent solids.
#pragma once

#include <vector>

#include "client/writers/raster.h"
#include "proto/scene_desc.h"

namespace headrace::client {

// Call after the particles, which hide what is behind them.
void draw_objects(Raster& raster, const std::vector<proto::ObjectDesc>& objects);

// 2D: outlines of containers, filled obstacles; `lift` [m] raises them above particles that touch them.
void draw_flat_objects(Raster& raster, const std::vector<proto::ObjectDesc>& objects, double lift);

}  // namespace headrace::client
