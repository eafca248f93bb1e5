// Who is near whom: for every cluster of centres the clusters that have a point within reach of one of its points.
//
// Exact and reused: the reach is the support and a skin, and cover() tells from actual displacements whether a pair
// within the support could be missing. Displacements are compared block against block, so a body of fluid that is
// carried along does not wear the list out; only relative motion does. In between the list is pruned: the loops see
// those entries only that a smaller skin reaches (the inner and outer list of Pall et al. 2020, J. Chem. Phys. 153,
// 134110). Blocks that have moved further than it allows see all entries again until the next pruning. Where only a few
// blocks outrun the skin, the pairs that come near are added to their lists (mend_block.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/solver/pairs/cluster_order.h"
#include "server/solver/pairs/cluster_points.h"
#include "server/solver/pairs/near_blocks.h"
#include "server/solver/pairs/pair_way.h"
#include "server/solver/visibility.h"

namespace headrace::solver {

// The lists of kBlockClusters clusters of centres.
template <class S>
struct PairBlock {
    std::array<PairRow, kBlockClusters + 1> rows{};  // of each centre; the last one tells where the entries end
    std::vector<PairWay<S>> ways;
    std::vector<PairEntry> entries;
    std::vector<std::uint16_t> seen;  // of each entry: bit 4 i + j: may they interact? Empty: all may.
    std::vector<Index> nearby;        // blocks of neighbours that could come within reach
    bool is_whole{true};              // do the loops see all entries?

    void bring_back() {
        for (std::size_t c = 0; c < kBlockClusters; ++c) rows[c].end = listed_end(c);
        is_whole = true;
    }

    // Where the centre's entries end, those included that were pruned away.
    Index listed_end(std::size_t centre) const { return rows[centre + 1].begin; }
    const PairWay<S>& way(const PairRow& row, Index entry) const { return ways[row.ways + way_of(entries[entry])]; }
    Index cluster(const PairRow& row, Index entry) const { return way(row, entry).first + place_of(entries[entry]); }

    // visit(centre cluster within the block, cluster of neighbours, entry) for all that are listed, and for those that
    // the loops see.
    template <class Visit>
    void for_each_listed(Visit&& visit) const {
        for (std::size_t c = 0; c < kBlockClusters; ++c)
            for (Index e = rows[c].begin; e < listed_end(c); ++e) visit(c, cluster(rows[c], e), e);
    }
    template <class Visit>
    void for_each_met(Visit&& visit) const {
        for (std::size_t c = 0; c < kBlockClusters; ++c)
            for (Index e = rows[c].begin; e < rows[c].end; ++e) visit(c, cluster(rows[c], e), e);
    }
};

// Which of the pairs that are near enough may interact.
class PairVisibility {
  public:
    virtual ~PairVisibility() = default;
    virtual bool is_needed_near(const Vec3& centre) const = 0;
    virtual bool may_interact(Index centre, Index neighbour) const = 0;
};

struct ReachOptions {
    double support{};                    // [m]
    double skin{};                       // [m]
    double inner_skin{};                 // [m] of the pruned list
    Vec3 period{};                       // [m]
    const PairVisibility* visibility{};  // null: all pairs may interact
    // Is each pair listed once, by the cluster that comes first? Each cluster lists itself, as its first entry. Only
    // where centres and neighbours are the same points, and all may interact.
    bool is_half{};
    double far_skins{3.0};  // blocks so many skins further apart than the reach are compared for their motion, too
};

// Do the loops see all pairs within the support, after the motion since the list was made?
enum class Coverage {
    lost,   // one may be missing: build() is due
    loose,  // yes, and so many others that prune() is due
    whole,
};

template <class S>
class PairList {
  public:
    // x: of the centres, in their order; grid: of the neighbours. Pruned for the places of now, from which both points'
    // motion must count.
    void build(const ClusterPoints<S>& centres, const VectorField& x, const ClusterPoints<S>& neighbours,
               const BlockGrid& grid, const ReachOptions& options);

    // Chooses the entries that the loops see, for the places of now, from which both points' motion must count.
    void prune(const ClusterPoints<S>& centres, const ClusterPoints<S>& neighbours);

    // The same pairs with centres and neighbours exchanged; the loops see all until prune().
    void build_transposed(const PairList& list, std::size_t centre_clusters);

    // Gives blocks their entries back whose pruned ones may be needed, and mends those that outrun the skin.
    Coverage cover(const ClusterPoints<S>& centres, const ClusterPoints<S>& neighbours);
    void bring_back();
    bool is_pruned() const;  // all of it

    // Asks again which pairs may interact.
    void refresh(const PairVisibility& visibility, std::size_t centres, std::size_t neighbours);

    const std::vector<PairBlock<S>>& blocks() const { return blocks_; }
    bool has_entries(std::size_t centre_cluster) const;
    std::size_t entries() const;  // that the loops see
    std::size_t bytes() const;

  private:
    struct alignas(64) Scratch {  // of one thread, which counts in it
        NearBlocks<S> near;
        std::vector<PairWay<S>> ways;
        std::vector<PairEntry> entries, far;
        std::vector<Index> maybe;
        std::vector<std::uint16_t> far_seen;
        std::size_t used{};  // entries

        void start_block();
        // Writes the block's lists.
        void finish_block(PairBlock<S>& block, bool needs_visibility);
    };
    struct Reverse {  // an entry seen from the other side
        Index cluster{};
        std::array<S, 3> offset{};
        bool needs_visibility{};
    };
    void build_transposed_block(std::size_t block, const std::vector<Index>& first, const std::vector<Reverse>& entries,
                                Scratch& scratch);
    void build_block(std::size_t block, const ClusterPoints<S>& centres, const VectorField& x,
                     const ClusterPoints<S>& neighbours, const ReachOptions& options, Scratch& scratch);

    double support_{}, skin_{}, far_skin_{}, inner_skin_{};  // [m]
    bool can_mend_{};                                        // walls have a list of the same pairs, which is not mended
    std::vector<PairBlock<S>> blocks_;
    std::vector<Scratch> scratch_;  // one per thread
};

extern template class PairList<float>;
extern template class PairList<double>;

}  // namespace headrace::solver
