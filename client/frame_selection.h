// Parts of a frame: the particles in a box, some of the fields.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "proto/frame.h"
#include "proto/scene_desc.h"

namespace headrace::client {

// The particles inside the box, faces included (2D: without regard to z), in the frame's order. The copied bytes lie in
// `bytes`, which outlives the view. Precondition: the frame has positions.
proto::FrameView select_region(const proto::FrameView& frame, const proto::BoxDesc& region,
                               std::vector<std::byte>& bytes);

// The same bytes, fewer columns.
proto::FrameView select_fields(const proto::FrameView& frame, proto::FieldSet fields);

}  // namespace headrace::client
