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

// [m] Of the particles, but for the outermost two in a thousand on each side: spray. Nowhere (min above max) without
// particles. Precondition: the frame has positions.
proto::BoxDesc bounds_without_spray(const proto::FrameView& frame);

// The same bytes, fewer columns.
proto::FrameView select_fields(const proto::FrameView& frame, proto::FieldSet fields);

}  // namespace headrace::client
