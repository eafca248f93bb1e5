#include "server/solver/pairs/pair_list.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/solver/pairs/mend_block.h"
#include "server/solver/pairs/reach_filter.h"
#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

// Pruning is due when one of so many blocks sees all of its entries.
constexpr std::size_t kMostWhole = 8;

// A new list is due when one of so many blocks is to be mended.
constexpr std::size_t kMostOpen = 8;

// Relative places are rounded: the reach is longer by this share.
constexpr double kRounding = 4e-6;

// Longest difference between a displacement of one box and one of the other, squared.
double difference2(const MotionBox& a, const MotionBox& b) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double longest = std::max(a.high[k] - b.low[k], b.high[k] - a.low[k]);
        sum += longest * longest;
    }
    return sum;
}

MotionBox join(const std::vector<MotionBox>& boxes, MotionBox all) {
    for (const MotionBox& box : boxes) {
        for (int k = 0; k < 3; ++k) {
            all.low[k] = std::min(all.low[k], box.low[k]);
            all.high[k] = std::max(all.high[k], box.high[k]);
        }
    }
    return all;
}

// Motion of the blocks of two kinds of points against each other.
class RelativeMotion {
  public:
    RelativeMotion(const std::vector<MotionBox>& centres, const std::vector<MotionBox>& neighbours,
                   bool neighbours_move)
        : centres_(centres), neighbours_(neighbours) {
        all_ = join(centres_, centres_.front());
        all_ = neighbours_move ? join(neighbours_, all_) : join({MotionBox{}}, all_);
    }

    double largest2() const { return difference2(all_, all_); }  // of any block against any

    // Before the following: the radii about the middle of all motion, which decide most cases.
    void measure_radii() {
        centre_radii_ = radii(centres_);
        neighbour_radii_ = radii(neighbours_);
        largest_radius_ = *std::max_element(neighbour_radii_.begin(), neighbour_radii_.end());
    }
    // false: is_longer() is so for every neighbour.
    bool can_be_longer(std::size_t centre, double way) const {
        return !(centre_radii_[centre] + largest_radius_ < static_cast<float>(way));
    }
    bool is_longer(std::size_t centre, std::size_t neighbour, double way) const {
        if (centre_radii_[centre] + neighbour_radii_[neighbour] < static_cast<float>(way)) return false;
        return difference2(centres_[centre], neighbours_[neighbour]) > way * way;
    }

  private:
    std::vector<float> radii(const std::vector<MotionBox>& boxes) const {
        constexpr float kRoundedUp = 1.0f + 1e-5f;
        std::vector<float> radii(boxes.size());
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            float sum = 0.0f;
            for (int k = 0; k < 3; ++k) {
                const float middle = 0.5f * (all_.low[k] + all_.high[k]);
                const float longest = std::max(boxes[b].high[k] - middle, middle - boxes[b].low[k]);
                sum += longest * longest;
            }
            radii[b] = std::sqrt(sum) * kRoundedUp;
        }
        return radii;
    }

    const std::vector<MotionBox>&centres_, &neighbours_;
    MotionBox all_;
    std::vector<float> centre_radii_, neighbour_radii_;
    float largest_radius_{};
};

}  // namespace

template <class S>
void PairList<S>::build(const ClusterPoints<S>& centres, const VectorField& x, const ClusterPoints<S>& neighbours,
                        const BlockGrid& grid, const ReachOptions& options) {
    support_ = options.support;
    skin_ = options.skin;
    inner_skin_ = std::min(options.inner_skin, options.skin);
    far_skin_ = options.far_skins * options.skin;
    can_mend_ = &centres == &neighbours && !grid.is_periodic() && options.visibility == nullptr && !options.is_half;
    const std::size_t count = (centres.clusters() + kBlockClusters - 1) / kBlockClusters;
    // Given back first: lists that grow one by one leave holes, and the memory of the longest that ever was.
    parallel_for(blocks_.size(), 4, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t b = first; b < last; ++b) blocks_[b] = {};
    });
    blocks_.resize(count);
    scratch_.resize(static_cast<std::size_t>(max_threads()));
    const double reach = (options.support + options.skin) * (1.0 + kRounding);
    const double far_reach = (options.support + skin_ + far_skin_) * (1.0 + kRounding);
    for (Scratch& scratch : scratch_)
        scratch.near.start({&centres, &x, &neighbours, &grid, reach, far_reach, options.period, options.is_half});
    parallel_for(count, 4, [&](std::size_t first, std::size_t last, int thread) {
        for (std::size_t b = first; b < last; ++b)
            build_block(b, centres, x, neighbours, options, scratch_[static_cast<std::size_t>(thread)]);
    });
    if (options.visibility != nullptr) refresh(*options.visibility, centres.size(), neighbours.size());
}

template <class S>
void PairList<S>::build_block(std::size_t b, const ClusterPoints<S>& centres, const VectorField& x,
                              const ClusterPoints<S>& neighbours, const ReachOptions& options, Scratch& scratch) {
    PairBlock<S>& block = blocks_[b];
    NearBlocks<S>& near = scratch.near;
    const std::size_t first = b * kBlockClusters, last = std::min(first + kBlockClusters, centres.clusters());
    near.find(first * kClusterSize, std::min(last * kClusterSize, centres.size()));
    block.nearby.assign(near.blocks().begin(), near.blocks().end());
    scratch.start_block();
    NearQuery<S> query;
    query.dimensions = centres.dimensions();
    query.records = neighbours.record(0);
    query.inner_reach = (support_ + inner_skin_) * (1.0 + kRounding);
    query.reach = (support_ + skin_) * (1.0 + kRounding);
    bool needs_visibility = false;
    block.rows.fill({});
    for (std::size_t c = first; c < last && !block.nearby.empty();) {
        const std::size_t end = centres.end_of_reference(c), first_way = scratch.ways.size();
        near.add_ways(c, end, scratch.ways);
        query.ways = scratch.ways.data() + first_way;
        query.sights = near.sights().data();
        query.way_count = near.sights().size();
        scratch.maybe.resize(std::max(scratch.maybe.size(), space_for_near(query.way_count)));
        scratch.far.resize(std::max(scratch.far.size(), space_for_near(query.way_count)));
        query.maybe = scratch.maybe.data();
        query.far = scratch.far.data();
        for (; c < end; ++c) {
            const std::size_t space = scratch.used + space_for_near(query.way_count);
            if (scratch.entries.size() < space) scratch.entries.resize(2 * space);
            query.centre = centres.record(c);
            query.centre_points = std::min(kClusterSize, centres.size() - c * kClusterSize);
            query.box = near.box_of(c);
            if (options.is_half) query.skipped = c % kBlockClusters;
            PairRow& row = block.rows[c - first];
            row.begin = static_cast<Index>(scratch.used);
            const ListedEntries listed = list_near(query, &scratch.entries[scratch.used]);
            row.end = row.begin + static_cast<Index>(listed.near);
            scratch.used += listed.count;
            row.ways = static_cast<Index>(first_way);
            if (options.visibility != nullptr) {
                Vec3 place{};
                for (int k = 0; k < centres.dimensions(); ++k) place[k] = x[k][c * kClusterSize];
                needs_visibility |= options.visibility->is_needed_near(place);
            }
        }
    }
    for (std::size_t c = last - first; c <= kBlockClusters; ++c)
        block.rows[c].begin = block.rows[c].end = static_cast<Index>(scratch.used);
    scratch.finish_block(block, needs_visibility);
    block.is_whole = inner_skin_ >= skin_;  // otherwise pruned
}

template <class S>
void PairList<S>::Scratch::start_block() {
    ways.clear();
    used = 0;
}

template <class S>
void PairList<S>::Scratch::finish_block(PairBlock<S>& block, bool needs_visibility) {
    block.ways.assign(ways.begin(), ways.end());
    block.entries.assign(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(used));
    block.is_whole = true;
    block.seen.clear();
    if (needs_visibility) block.seen.assign(block.entries.size(), 0xffff);
}

template <class S>
void PairList<S>::build_transposed(const PairList& list, std::size_t centre_clusters) {
    support_ = list.support_;
    skin_ = list.skin_;
    inner_skin_ = list.inner_skin_;
    far_skin_ = list.far_skin_;
    blocks_.resize((centre_clusters + kBlockClusters - 1) / kBlockClusters);
    scratch_.resize(static_cast<std::size_t>(max_threads()));
    std::vector<Index> first(blocks_.size() * kBlockClusters + 1, 0);  // of each centre's entries
    for (const PairBlock<S>& block : list.blocks_)
        block.for_each_listed([&](std::size_t, Index j, Index) { ++first[j + 1]; });
    for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
    std::vector<Reverse> entries(first.back());
    std::vector<Index> next(first.begin(), first.end() - 1);
    for (std::size_t b = 0; b < list.blocks_.size(); ++b) {
        const PairBlock<S>& block = list.blocks_[b];
        block.for_each_listed([&](std::size_t c, Index j, Index e) {
            const auto& offset = block.way(block.rows[c], e).offset;
            entries[next[j]++] = {
                static_cast<Index>(b * kBlockClusters + c), {-offset[0], -offset[1], -offset[2]}, !block.seen.empty()};
        });
    }
    parallel_for(blocks_.size(), 4, [&](std::size_t begin, std::size_t end, int thread) {
        for (std::size_t b = begin; b < end; ++b)
            build_transposed_block(b, first, entries, scratch_[static_cast<std::size_t>(thread)]);
    });
}

// Entries in the order in which they come.
template <class S>
void PairList<S>::build_transposed_block(std::size_t b, const std::vector<Index>& first,
                                         const std::vector<Reverse>& entries, Scratch& scratch) {
    PairBlock<S>& block = blocks_[b];
    block.nearby.clear();
    scratch.start_block();
    scratch.entries.resize(
        std::max<std::size_t>(scratch.entries.size(), first[(b + 1) * kBlockClusters] - first[b * kBlockClusters]));
    bool needs_visibility = false;
    std::size_t hint = 0;
    for (std::size_t c = 0; c < kBlockClusters; ++c) {
        const Index begin = first[b * kBlockClusters + c], end = first[b * kBlockClusters + c + 1];
        // Centres that stand together share their ways, as long as there are numbers for those that may come.
        Index first_way = c == 0 ? 0 : block.rows[c - 1].ways;
        if (scratch.ways.size() - first_way + (end - begin) > kMostWays)
            first_way = static_cast<Index>(scratch.ways.size());
        block.rows[c] = {static_cast<Index>(scratch.used), static_cast<Index>(scratch.used + end - begin), first_way};
        for (Index e = begin; e < end; ++e) {
            needs_visibility |= entries[e].needs_visibility;
            const Index place = entries[e].cluster % kBlockClusters;
            const Index number =
                number_of_way(scratch.ways, first_way, {entries[e].offset, entries[e].cluster - place}, hint);
            scratch.entries[scratch.used++] = make_entry(number, place);
        }
    }
    block.rows[kBlockClusters] = {static_cast<Index>(scratch.used), static_cast<Index>(scratch.used), 0};
    scratch.finish_block(block, needs_visibility);
}

template <class S>
void PairList<S>::prune(const ClusterPoints<S>& centres, const ClusterPoints<S>& neighbours) {
    if (inner_skin_ >= skin_) return;
    scratch_.resize(static_cast<std::size_t>(max_threads()));
    const double reach = (support_ + inner_skin_) * (1.0 + kRounding);
    parallel_for(blocks_.size(), 4, [&](std::size_t begin, std::size_t end, int thread) {
        Scratch& scratch = scratch_[static_cast<std::size_t>(thread)];
        for (std::size_t b = begin; b < end; ++b) {
            PairBlock<S>& block = blocks_[b];
            block.is_whole = false;
            if (block.entries.empty()) continue;
            scratch.far.resize(std::max(scratch.far.size(), block.entries.size()));
            scratch.far_seen.resize(scratch.far.size());
            PruneQuery<S> query;
            query.dimensions = centres.dimensions();
            query.records = neighbours.record(0);
            query.reach = reach;
            query.far = scratch.far.data();
            query.far_seen = scratch.far_seen.data();
            for (std::size_t c = 0; c < kBlockClusters; ++c) {
                PairRow& row = block.rows[c];
                query.count = block.listed_end(c) - row.begin;
                if (query.count == 0) continue;
                const std::size_t cluster = b * kBlockClusters + c;
                query.centre = centres.record(cluster);
                query.centre_points = std::min(kClusterSize, centres.size() - cluster * kClusterSize);
                query.ways = block.ways.data() + row.ways;
                query.entries = block.entries.data() + row.begin;
                query.seen = block.seen.empty() ? nullptr : block.seen.data() + row.begin;
                row.end = row.begin + static_cast<Index>(prune_to_reach(query));
            }
        }
    });
}

template <class S>
Coverage PairList<S>::cover(const ClusterPoints<S>& centres, const ClusterPoints<S>& neighbours) {
    if (centres.motion().empty() || neighbours.motion().empty()) return Coverage::whole;
    RelativeMotion total(centres.total_motion(), neighbours.total_motion(), neighbours.moves());
    if (!(total.largest2() <= (skin_ + far_skin_) * (skin_ + far_skin_))) return Coverage::lost;
    RelativeMotion recent(centres.motion(), neighbours.motion(), neighbours.moves());
    if (total.largest2() <= skin_ * skin_ && recent.largest2() <= inner_skin_ * inner_skin_) return Coverage::whole;
    if (std::all_of(blocks_.begin(), blocks_.end(), [](const PairBlock<S>& block) { return block.nearby.empty(); }))
        return Coverage::whole;
    total.measure_radii();
    recent.measure_radii();
    struct Found {
        bool is_lost{};
        std::size_t whole_blocks{}, open_blocks{};
    };
    // Halfway into the skin: not in every step anew.
    const double reach = (support_ + 0.5 * skin_) * (1.0 + kRounding);
    const std::size_t most_open = can_mend_ ? blocks_.size() / kMostOpen : 0;
    const Found found = parallel_reduce(
        blocks_.size(), Found{},
        [&](std::size_t first, std::size_t last) {
            Found here;
            std::vector<Index> open;
            for (std::size_t b = first; b < last; ++b) {
                PairBlock<S>& block = blocks_[b];
                open.clear();
                if (total.can_be_longer(b, skin_)) {
                    for (const Index j : block.nearby)
                        if (total.is_longer(b, j, skin_)) open.push_back(j);
                }
                if (!block.is_whole && recent.can_be_longer(b, inner_skin_)) {
                    const auto is_outrun = [&](Index j) { return recent.is_longer(b, j, inner_skin_); };
                    if (std::any_of(block.nearby.begin(), block.nearby.end(), is_outrun)) block.bring_back();
                }
                here.whole_blocks += block.is_whole;
                if (open.empty()) continue;
                if (++here.open_blocks > most_open) {
                    here.is_lost = true;
                    return here;
                }
                if (!mend_block(block, b, centres, neighbours, open, reach)) {
                    here.is_lost = true;
                    return here;
                }
            }
            return here;
        },
        [](Found a, const Found& b) {
            return Found{a.is_lost || b.is_lost, a.whole_blocks + b.whole_blocks, a.open_blocks + b.open_blocks};
        });
    if (found.is_lost || found.open_blocks > most_open) return Coverage::lost;
    const bool is_loose = inner_skin_ < skin_ && found.whole_blocks * kMostWhole > blocks_.size();
    return is_loose ? Coverage::loose : Coverage::whole;
}

template <class S>
void PairList<S>::bring_back() {
    for (PairBlock<S>& block : blocks_) block.bring_back();
}

template <class S>
bool PairList<S>::is_pruned() const {
    return std::none_of(blocks_.begin(), blocks_.end(), [](const PairBlock<S>& block) { return block.is_whole; });
}

template <class S>
void PairList<S>::refresh(const PairVisibility& visibility, std::size_t centres, std::size_t neighbours) {
    parallel_for(blocks_.size(), 1, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t b = first; b < last; ++b) {
            PairBlock<S>& block = blocks_[b];
            if (block.seen.empty()) continue;
            block.for_each_listed([&](std::size_t c, Index cluster, Index e) {
                std::uint16_t seen = 0;
                for (std::size_t k = 0; k < kClusterSize * kClusterSize; ++k) {
                    const std::size_t i = (b * kBlockClusters + c) * kClusterSize + k / kClusterSize;
                    const std::size_t j = cluster * kClusterSize + k % kClusterSize;
                    if (i >= centres || j >= neighbours) continue;
                    if (visibility.may_interact(static_cast<Index>(i), static_cast<Index>(j)))
                        seen = static_cast<std::uint16_t>(seen | (1u << k));
                }
                block.seen[e] = seen;
            });
        }
    });
}

template <class S>
bool PairList<S>::has_entries(std::size_t centre_cluster) const {
    const PairBlock<S>& block = blocks_[centre_cluster / kBlockClusters];
    const std::size_t c = centre_cluster % kBlockClusters;
    return block.rows[c].begin < block.listed_end(c);
}

template <class S>
std::size_t PairList<S>::entries() const {
    std::size_t count = 0;
    for (const PairBlock<S>& block : blocks_)
        for (const PairRow& row : block.rows) count += row.end - row.begin;
    return count;
}

template <class S>
std::size_t PairList<S>::bytes() const {
    std::size_t bytes = blocks_.capacity() * sizeof(PairBlock<S>);
    for (const PairBlock<S>& block : blocks_)
        bytes += block.ways.capacity() * sizeof(PairWay<S>) + block.entries.capacity() * sizeof(PairEntry) +
                 block.nearby.capacity() * sizeof(Index) + block.seen.capacity() * sizeof(std::uint16_t);
    return bytes;
}

template class PairList<float>;
template class PairList<double>;

}  // namespace headrace::solver
