// Collision objects in a picture: containers as thin glass, obstacles as translucent solids, planes as sheets.
#pragma once

#include <vector>

#include "client/writers/placed_object.h"
#include "client/writers/raster.h"
#include "client/writers/stage.h"

namespace headrace::client {

// Planes have no end: they are drawn within this.
proto::BoxDesc room_of_planes(const Stage& stage);

// Call after the particles, which hide what is behind them.
void draw_objects(Raster& raster, const std::vector<PlacedObject>& objects, const Stage& stage);

// 2D: outlines of containers, filled obstacles; `lift` [m] raises them above particles that touch them.
void draw_flat_objects(Raster& raster, const std::vector<PlacedObject>& objects, const Stage& stage, double lift);

}  // namespace headrace::client
