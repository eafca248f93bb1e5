// Boxes along the axes, to find out what there is to see. Unions start from kNowhere.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "client/writers/vec3.h"
#include "proto/scene_desc.h"

namespace headrace::client {

// Corner k of a box, 0 <= k < 8: bit 0 takes x, bit 1 y, bit 2 z from max.
inline Vec3 box_corner(const proto::BoxDesc& box, int k) {
    return {(k & 1 ? box.max : box.min)[0], (k & 2 ? box.max : box.min)[1], (k & 4 ? box.max : box.min)[2]};
}

inline constexpr double kInfinitelyFarAway = std::numeric_limits<double>::infinity();
inline constexpr proto::BoxDesc kNowhere{{kInfinitelyFarAway, kInfinitelyFarAway, kInfinitelyFarAway},
                                         {-kInfinitelyFarAway, -kInfinitelyFarAway, -kInfinitelyFarAway}};

inline bool is_nowhere(const proto::BoxDesc& box) {
    return box.min[0] > box.max[0];
}
inline void include(proto::BoxDesc& bounds, const proto::BoxDesc& box) {
    for (std::size_t k = 0; k < 3; ++k) {
        bounds.min[k] = std::min(bounds.min[k], box.min[k]);
        bounds.max[k] = std::max(bounds.max[k], box.max[k]);
    }
}
// The smallest box around them.
inline proto::BoxDesc bounds_of(std::span<const Vec3> points) {
    proto::BoxDesc bounds = kNowhere;
    for (const Vec3& point : points) include(bounds, {point, point});
    return bounds;
}
// What two boxes have in common; `box` where that is nothing.
inline proto::BoxDesc common_part(const proto::BoxDesc& box, const proto::BoxDesc& other) {
    proto::BoxDesc common = box;
    for (std::size_t k = 0; k < 3; ++k) {
        common.min[k] = std::max(box.min[k], other.min[k]);
        common.max[k] = std::min(box.max[k], other.max[k]);
        if (common.min[k] > common.max[k]) return box;
    }
    return common;
}
inline proto::BoxDesc grown(const proto::BoxDesc& box, double margin) {
    return {{box.min[0] - margin, box.min[1] - margin, box.min[2] - margin},
            {box.max[0] + margin, box.max[1] + margin, box.max[2] + margin}};
}

}  // namespace headrace::client
