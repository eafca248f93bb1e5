#include "server/solver/pairs/pair_neighbours.h"

#include <algorithm>

#include "server/solver/parallel.h"

namespace headrace::solver {

template <class S>
void PairNeighboursOf<S>::find(const NeighbourInput& input) {
    input_ = input;
    const auto start = [&](ClusterPoints<S>& points, const OrderedPoints& of, bool moves) {
        points.start(*of.x, of.V, of.count, input.dimensions, input.reach.support, moves);
    };
    ReachOptions reach = input.reach;
    start(fluid_, input.fluid, true);
    reach.visibility = input.among_fluid;
    among_fluid_.build(fluid_, *input.fluid.x, fluid_, input.fluid.order->blocks(), reach);
    if (input.walls.count == 0) {
        walls_ = {};
        fluid_.forget_boxes();
        return;
    }
    if (input.has_new_walls) start(walls_, input.walls, input.walls_move);
    walls_.settle();
    reach.visibility = input.fluid_to_wall;
    if (input.wall_skin > 0.0) reach.skin = input.wall_skin;
    fluid_to_wall_.build(fluid_, *input.fluid.x, walls_, input.walls.order->blocks(), reach);
    fluid_.forget_boxes();
    wall_to_fluid_.build_transposed(fluid_to_wall_, walls_.clusters());
    if (input.wall_to_fluid != nullptr) wall_to_fluid_.refresh(*input.wall_to_fluid, walls_.size(), fluid_.size());
    wall_to_fluid_.prune(walls_, fluid_);
}

// For the places of now.
template <class S>
void PairNeighboursOf<S>::prune() {
    fluid_.settle();
    among_fluid_.prune(fluid_, fluid_);
    if (!has_walls()) return;
    walls_.settle();
    fluid_to_wall_.prune(fluid_, walls_);
    wall_to_fluid_.prune(walls_, fluid_);
}

// Brings pruned pairs back and prunes anew as it pays; false where only find() makes the lists whole.
template <class S>
bool PairNeighboursOf<S>::keep_whole() {
    Coverage coverage = among_fluid_.cover(fluid_, fluid_);
    if (has_walls() && coverage != Coverage::lost) {
        coverage = std::min(coverage, fluid_to_wall_.cover(fluid_, walls_));
        // The same pairs: motion is compared from the fluid's side only.
        if (!fluid_to_wall_.is_pruned() && wall_to_fluid_.is_pruned()) wall_to_fluid_.bring_back();
    }
    if (coverage == Coverage::loose) prune();
    return coverage != Coverage::lost;
}

template <class S>
bool PairNeighboursOf<S>::move_fluid(const VectorField& x, const FieldView& V) {
    fluid_.update(x, V);
    return keep_whole();
}

template <class S>
bool PairNeighboursOf<S>::move_walls(const VectorField& x, const FieldView& V) {
    walls_.update(x, V);
    return keep_whole();
}

template <class S>
void PairNeighboursOf<S>::refresh_visibility() {
    if (input_.among_fluid == nullptr) return;
    among_fluid_.refresh(*input_.among_fluid, fluid_.size(), fluid_.size());
    if (!has_walls()) return;
    fluid_to_wall_.refresh(*input_.fluid_to_wall, fluid_.size(), walls_.size());
    wall_to_fluid_.refresh(*input_.wall_to_fluid, walls_.size(), fluid_.size());
}

template <class S>
bool PairNeighboursOf<S>::is_near_walls(std::size_t fluid_cluster) const {
    return has_walls() && fluid_to_wall_.has_entries(fluid_cluster);
}

template <class S>
void PairNeighboursOf<S>::for_each_wall_pair(const std::function<void(Index wall, Index fluid)>& visit) const {
    if (!has_walls()) return;
    const auto visit_clusters = [&](std::size_t wall_cluster, std::size_t fluid_cluster) {
        const auto end = [](std::size_t cluster, std::size_t count) {
            return std::min((cluster + 1) * kClusterSize, count);
        };
        for (std::size_t w = wall_cluster * kClusterSize; w < end(wall_cluster, walls_.size()); ++w) {
            for (std::size_t i = fluid_cluster * kClusterSize; i < end(fluid_cluster, fluid_.size()); ++i)
                visit(static_cast<Index>(w), static_cast<Index>(i));
        }
    };
    const auto& blocks = wall_to_fluid_.blocks();
    parallel_for(blocks.size(), 1, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t b = first; b < last; ++b) {
            blocks[b].for_each_met([&](std::size_t c, Index fluid_cluster, Index) {
                visit_clusters(b * kBlockClusters + c, fluid_cluster);
            });
        }
    });
}

template <class S>
std::size_t PairNeighboursOf<S>::bytes() const {
    return among_fluid_.bytes() + (has_walls() ? fluid_to_wall_.bytes() + wall_to_fluid_.bytes() : 0);
}

template <class S>
double PairNeighboursOf<S>::neighbours_per_particle() const {
    if (fluid_.size() == 0) return 0.0;
    const std::size_t entries = among_fluid_.entries() + (has_walls() ? fluid_to_wall_.entries() : 0);
    return static_cast<double>(entries * kClusterSize) / static_cast<double>(fluid_.clusters());
}

template class PairNeighboursOf<float>;
template class PairNeighboursOf<double>;

std::unique_ptr<PairNeighbours> make_pair_neighbours(Arithmetic arithmetic) {
    if (arithmetic == Arithmetic::double_precision) return std::make_unique<PairNeighboursOf<double>>();
    return std::make_unique<PairNeighboursOf<float>>();
}

}  // namespace headrace::solver
