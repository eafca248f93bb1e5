#include "client/writers/block_faces.h"

#include <algorithm>

namespace headrace::client {

namespace {

std::array<Edge, 12> make_edges() {
    std::array<Edge, 12> edges{};
    std::size_t count = 0;
    for (std::size_t from = 0; from < 8; ++from)
        for (const std::size_t axis : {1, 2, 4}) {
            const std::size_t to = from | axis;
            if (to == from) continue;
            Edge& edge = edges[count++];
            edge.from = from, edge.to = to;
            std::size_t found = 0;
            for (const Face& face : kFaces) {
                const auto has = [&](std::size_t corner) { return std::ranges::count(face.corners, corner) > 0; };
                if (has(from) && has(to)) edge.faces[found++] = &face;
            }
        }
    return edges;
}

// Shorter at the cut, and open there; what is above or below altogether stays. Precondition: the block is not turned.
OpenBlock cut_open(const Block& whole, const Stage& stage) {
    if (!stage.cutaway) return {whole};
    const auto [axis, is_max, at] = *stage.cutaway;
    proto::BoxDesc box{whole.corners.front(), whole.corners.back()};
    if (!(box.min[axis] < at && at < box.max[axis])) return {whole};
    (is_max ? box.max : box.min)[axis] = at;
    return {Block(box), &kFaces[2 * axis + (is_max ? 1 : 0)]};
}

}  // namespace

Vec3 normal_of(const Block& block, const Face& face) {
    const Vec3 along = normalized(block.edge(face.axis));
    return face.is_max ? along : -1 * along;
}

const std::array<Edge, 12>& block_edges() {
    static const std::array<Edge, 12> edges = make_edges();
    return edges;
}

OpenBlock shown_container(const PlacedObject& container, const Stage& stage) {
    const Block whole = std::get<Block>(placed_shape(container));
    return container.place.is_turned() ? OpenBlock{whole} : cut_open(whole, stage);
}

OpenBlock shown_obstacle(const PlacedObject& obstacle, const std::vector<PlacedObject>& objects, const Stage& stage) {
    const Block visible = visible_block(obstacle, objects);
    return obstacle.place.is_turned() ? OpenBlock{visible} : cut_open(visible, stage);
}

}  // namespace headrace::client
