// The storage order of the pair engine: points in rows along x, so that four in a row are close together.
//
// Space is divided into rows of square cross-section, about as wide as the edge of a cube of four points, and each row
// into bins about a quarter of that long. Points are sorted by row and bin; every four of them are a cluster. Rows are
// walked through to and fro, so that a cluster at a row's end has its other points in the next row's near end.
// Clusters are stored in bundles of neighbouring rows, in a bundle by their place along it: some that stand in a row
// are as compact a body as a few can be, which moves together and has few neighbours. Dense layout: bundles are taken
// strip by strip, each strip layer by layer, so that what is near in space is near in memory however large the whole
// is.
//
// Within a bin points stand in the order of their ids: the order is a function of places and ids alone.
//
// The walk goes through a table of all bins. Where that would take more than kDenseBins per point (drops far apart),
// points are sorted by bin.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/solver/objects.h"
#include "server/solver/pairs/block_grid.h"
#include "server/solver/parallel.h"
#include "server/solver/particles.h"
#include "server/solver/space_division.h"

namespace headrace::solver {

inline constexpr std::size_t kClusterSize = 4;
// Clusters of a block: what is known of neighbours and of motion is known of blocks.
inline constexpr std::size_t kBlockClusters = 16;

class ClusterOrder {
  public:
    // Finds the order. spacing [m] sets the width of rows. Along the domain's periodic axes x must be in [min, max).
    void build(const VectorField& x, const std::vector<Index>& id, int dimensions, double spacing,
               const Domain& domain);

    // Puts one array of the points into the order found by build().
    template <class T>
    void permute(std::vector<T>& values, std::vector<T>& scratch) const;

    // After the last permute(): gives the memory back that only permute() needs.
    void forget_moves() { std::vector<Index>().swap(order_); }

    std::size_t size() const { return count_; }
    std::size_t clusters() const { return (size() + kClusterSize - 1) / kClusterSize; }

    const BlockGrid& blocks() const { return blocks_; }

  private:
    static constexpr std::size_t kDenseBins = 8;
    static constexpr std::size_t kDenseMinimum = 65536;

    // Coordinates that compare lexicographically in the order of the walk.
    static Bin in_walking_order(const Bin& bin);
    std::size_t number_of(const Bin& bin) const;
    bool is_dense() const;
    void order_dense(const VectorField& x, const std::vector<Index>& id);
    void order_sparse(const VectorField& x, const std::vector<Index>& id);
    // What a cluster is stored by whose points are in the bins first to last: bundle and place along it.
    Bin bundle_of(const Bin& first, const Bin& last) const;
    void store_in_bundles(const VectorField& x, bool is_dense);
    std::vector<Index> place_dense(const std::vector<Bin>& bundles) const;
    static std::vector<Index> place_sparse(const std::vector<Bin>& bundles);

    SpaceDivision division_;
    BinRange range_;            // of the points
    std::size_t count_{};       // points
    std::vector<Index> order_;  // [count] old slot of the point that belongs into this slot, for permute()
    BlockGrid blocks_;
};

template <class T>
void ClusterOrder::permute(std::vector<T>& values, std::vector<T>& scratch) const {
    scratch.resize(count_);
    parallel_for(count_, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) scratch[i] = values[order_[i]];
    });
    values.swap(scratch);
}

}  // namespace headrace::solver
