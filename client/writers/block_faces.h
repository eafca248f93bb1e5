// Faces and edges of blocks, for drawing them; tanks are cut open where the stage says.
#pragma once

#include <array>
#include <optional>

#include "client/writers/placed_object.h"
#include "client/writers/stage.h"

namespace headrace::client {

// Corners as box_corner counts them; the face is at the min or the max end of an axis.
struct Face {
    std::array<std::size_t, 4> corners;
    int axis;
    bool is_max;
};
inline constexpr std::array<Face, 6> kFaces{{
    // by axis, min before max
    {{0, 4, 6, 2}, 0, false},
    {{1, 3, 7, 5}, 0, true},
    {{0, 1, 5, 4}, 1, false},
    {{2, 6, 7, 3}, 1, true},
    {{0, 2, 3, 1}, 2, false},
    {{4, 5, 7, 6}, 2, true},
}};

Vec3 normal_of(const Block& block, const Face& face);  // outwards, of length 1

struct Edge {
    std::size_t from, to;              // corners
    std::array<const Face*, 2> faces;  // that meet there
};
const std::array<Edge, 12>& block_edges();

// A block as it is shown: its faces but `open`, and the edges that `open` has no part in.
struct OpenBlock {
    Block block;
    const Face* open{nullptr};  // null: closed

    bool has(const Face& face) const { return &face != open; }
    bool has(const Edge& edge) const { return edge.faces[0] != open && edge.faces[1] != open; }
};

// Cut open where the stage says; turned ones stay closed. Precondition: boxes.
OpenBlock shown_container(const PlacedObject& container, const Stage& stage);
OpenBlock shown_obstacle(const PlacedObject& obstacle, const std::vector<PlacedObject>& objects, const Stage& stage);

}  // namespace headrace::client
