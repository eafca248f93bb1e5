#include "server/solver/pairs/pair_list.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/solver/pairs/mend_block.h"
#include "server/solver/pairs/reach_filter.h"
#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

// Blocks further apart than the reach and this many skins are not compared one by one: all displacements together may
// not exceed it.
constexpr double kFarSkins = 3.0;

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

    // Before is_longer(): the radii about the middle of all motion, which decide most cases.
    void measure_radii() {
        centre_radii_ = radii(centres_);
        neighbour_radii_ = radii(neighbours_);
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
};

}  // namespace

template <class S>
void PairList<S>::build(const ClusterPoints<S>& centres, const VectorField& x, const ClusterPoints<S>& neighbours,
                        const ClusterOrder& order, const ReachOptions& options) {
    support_ = options.support;
    skin_ = options.skin;
    inner_skin_ = std::min(options.inner_skin, options.skin);
    far_skin_ = kFarSkins * options.skin;
    can_mend_ = &centres == &neighbours && !order.is_periodic() && options.visibility == nullptr;
    const std::size_t count = (centres.clusters() + kMotionBlock - 1) / kMotionBlock;
    blocks_.resize(count);
    scratch_.resize(static_cast<std::size_t>(max_threads()));
    const double reach = (options.support + options.skin) * (1.0 + kRounding);
    for (Scratch& scratch : scratch_) {
        scratch.stamp.clear();
        scratch.clusters.start({&centres, &x, &neighbours, &order, reach, options.period});
    }
    parallel_for(count, 4, [&](std::size_t first, std::size_t last, int thread) {
        for (std::size_t b = first; b < last; ++b)
            build_block(b, centres, x, order, options, scratch_[static_cast<std::size_t>(thread)]);
    });
    if (options.visibility != nullptr) refresh(*options.visibility, centres.size(), neighbours.size());
}

template <class S>
void PairList<S>::build_block(std::size_t b, const ClusterPoints<S>& centres, const VectorField& x,
                              const ClusterOrder& order, const ReachOptions& options, Scratch& scratch) {
    PairBlock<S>& block = blocks_[b];
    scratch.start_block();
    const std::size_t first = b * kMotionBlock, last = std::min(first + kMotionBlock, centres.clusters());
    for (std::size_t c = first; c < last; ++c) {
        const std::size_t begin = c * kClusterSize, end = std::min(begin + kClusterSize, centres.size());
        scratch.extents[c - first] = extent_of(x, centres.dimensions(), begin, end);
    }
    list_nearby(block, x, centres.dimensions(), first * kClusterSize, std::min(last * kClusterSize, centres.size()),
                order, options, scratch);
    block.first_group.fill(0);
    bool needs_visibility = false;
    for (std::size_t c = first; c < last && !block.nearby.empty();) {
        const std::size_t end = scratch.clusters.find(c, last, &scratch.extents[c - first]);
        scratch.forget_ways_from();  // those found are others
        for (; c < end; ++c) {
            block.first_group[c - first] = static_cast<Index>(scratch.groups.size());
            if (options.visibility != nullptr)
                needs_visibility |= options.visibility->is_needed_near(scratch.extents[c - first].low);
            list_near(scratch, c, centres.reference(c));
        }
    }
    for (std::size_t c = last - first; c <= kMotionBlock; ++c)
        block.first_group[c] = static_cast<Index>(scratch.groups.size());
    scratch.finish_block(block, needs_visibility);
}

template <class S>
void PairList<S>::Scratch::start_block() {
    groups.clear();
    ways.clear();
    entries.clear();
    next_way = 0;
}

template <class S>
void PairList<S>::Scratch::finish_block(PairBlock<S>& block, bool needs_visibility) {
    const auto end = static_cast<Index>(entries.size());
    groups.push_back({end, end, 0});
    block.groups.assign(groups.begin(), groups.end());
    block.ways.assign(ways.begin(), ways.end());
    block.entries.assign(entries.begin(), entries.end());
    block.is_whole = true;
    block.seen.clear();
    if (needs_visibility) block.seen.assign(block.entries.size(), 0xffff);
}

// Centres that stand together see the same ways in the same order: mostly it is the one behind the last one asked for.
template <class S>
Index PairList<S>::Scratch::way_number(const PairWay<S>& way) {
    for (std::size_t n = 0; n < ways.size(); ++n) {
        if (next_way >= ways.size()) next_way = 0;
        if (ways[next_way++] == way) return next_way - 1;
    }
    ways.push_back(way);
    next_way = static_cast<Index>(ways.size());
    return next_way - 1;
}

template <class S>
std::vector<Index>& PairList<S>::Scratch::way_numbers_from(const std::array<std::int32_t, 3>& reference,
                                                           std::size_t count) {
    for (std::size_t r = 0; r < references; ++r) {
        if (ways_from[r].reference == reference) return ways_from[r].numbers;
    }
    if (references == ways_from.size()) ways_from.emplace_back();
    WaysFrom& from = ways_from[references++];
    from.reference = reference;
    from.numbers.assign(count, kNone);
    return from.numbers;
}

// Entries on one way are a group.
template <class S>
void PairList<S>::list_near(Scratch& scratch, std::size_t centre, const std::array<std::int32_t, 3>& reference) {
    const auto near = scratch.clusters.near(centre);
    std::vector<Index>& numbers = scratch.way_numbers_from(reference, near.way_count);
    const auto base = static_cast<Index>(scratch.entries.size());
    Index begin = 0;
    for (std::size_t w = 0; w < near.way_count; ++w) {
        const Index end = near.end_of_way[w];
        if (end > begin) {
            if (numbers[w] == Scratch::kNone) numbers[w] = scratch.way_number(near.ways[w].way);
            scratch.groups.push_back({base + begin, base + end, numbers[w]});
        }
        begin = end;
    }
    scratch.entries.resize(base + begin);
    for (Index n = 0; n < begin; ++n) scratch.entries[base + n] = static_cast<PairEntry>(near.clusters[n]);
}

template <class S>
void PairList<S>::build_transposed(const PairList& list, std::size_t centre_clusters) {
    support_ = list.support_;
    skin_ = list.skin_;
    inner_skin_ = list.inner_skin_;
    far_skin_ = list.far_skin_;
    blocks_.resize((centre_clusters + kMotionBlock - 1) / kMotionBlock);
    scratch_.resize(static_cast<std::size_t>(max_threads()));
    std::vector<Index> first(blocks_.size() * kMotionBlock + 1, 0);  // of each centre's entries
    for (const PairBlock<S>& block : list.blocks_)
        block.for_each_listed([&](std::size_t, Index j, Index) { ++first[j + 1]; });
    for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
    std::vector<Reverse> entries(first.back());
    std::vector<Index> next(first.begin(), first.end() - 1);
    for (std::size_t b = 0; b < list.blocks_.size(); ++b) {
        const PairBlock<S>& block = list.blocks_[b];
        for (std::size_t c = 0; c < kMotionBlock; ++c) {
            for (Index g = block.first_group[c]; g < block.first_group[c + 1]; ++g) {
                const PairWay<S>& way = block.way(block.groups[g]);
                const Reverse reverse{static_cast<Index>(b * kMotionBlock + c),
                                      {-way.offset[0], -way.offset[1], -way.offset[2]},
                                      !block.seen.empty()};
                for (Index e = block.groups[g].begin; e < block.listed_end(g); ++e)
                    entries[next[way.page + block.entries[e]]++] = reverse;
            }
        }
    }
    parallel_for(blocks_.size(), 4, [&](std::size_t begin, std::size_t end, int thread) {
        for (std::size_t b = begin; b < end; ++b)
            build_transposed_block(b, first, entries, scratch_[static_cast<std::size_t>(thread)]);
    });
}

// Entries of one way are a group, in the order in which they come.
template <class S>
void PairList<S>::build_transposed_block(std::size_t b, const std::vector<Index>& first,
                                         const std::vector<Reverse>& entries, Scratch& scratch) {
    PairBlock<S>& block = blocks_[b];
    block.nearby.clear();
    scratch.start_block();
    bool needs_visibility = false;
    for (std::size_t c = 0; c < kMotionBlock; ++c) {
        block.first_group[c] = static_cast<Index>(scratch.groups.size());
        const Index begin = first[b * kMotionBlock + c], end = first[b * kMotionBlock + c + 1];
        std::vector<Index>& ways = scratch.ways_of_centre;
        ways.clear();
        for (Index e = begin; e < end; ++e) {
            needs_visibility |= entries[e].needs_visibility;
            const Index way = scratch.way_number({page_of(entries[e].cluster), entries[e].offset});
            if (std::find(ways.begin(), ways.end(), way) == ways.end()) ways.push_back(way);
        }
        for (const Index way : ways) {
            const auto from = static_cast<Index>(scratch.entries.size());
            for (Index e = begin; e < end; ++e) {
                const PairWay<S> of_entry{page_of(entries[e].cluster), entries[e].offset};
                if (of_entry == scratch.ways[way])
                    scratch.entries.push_back(static_cast<PairEntry>(entries[e].cluster));
            }
            scratch.groups.push_back({from, static_cast<Index>(scratch.entries.size()), way});
        }
    }
    block.first_group[kMotionBlock] = static_cast<Index>(scratch.groups.size());
    scratch.finish_block(block, needs_visibility);
}

template <class S>
void PairList<S>::list_nearby(PairBlock<S>& block, const VectorField& x, int dimensions, std::size_t begin,
                              std::size_t end, const ClusterOrder& order, const ReachOptions& options,
                              Scratch& scratch) const {
    constexpr Index kSlots = kMotionBlock * kClusterSize;
    const double reach = (options.support + skin_ + far_skin_) * (1.0 + kRounding);
    scratch.nearby.clear();
    scratch.stamp.resize((order.clusters() + kMotionBlock - 1) / kMotionBlock, 0);
    const std::size_t clusters = (end - begin + kClusterSize - 1) / kClusterSize;
    Extent extent = scratch.extents[0];
    for (std::size_t c = 1; c < clusters; ++c) extent = join(extent, scratch.extents[c]);
    const auto look = static_cast<Index>(begin / kSlots + 1);
    for_each_run_near(order, x, dimensions, begin, end, extent, reach, [&](const RowRun& run) {
        for (Index n = run.begin / kClusterSize; n <= (run.end - 1) / kClusterSize; ++n) {
            const auto j = static_cast<Index>(order.cluster_at(n) / kMotionBlock);
            if (std::exchange(scratch.stamp[j], look) != look) scratch.nearby.push_back(j);
        }
    });
    block.nearby.assign(scratch.nearby.begin(), scratch.nearby.end());
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
            query.ways = block.ways.data();
            query.entries = block.entries.data();
            query.seen = block.seen.empty() ? nullptr : block.seen.data();
            query.reach = reach;
            query.far = scratch.far.data();
            query.far_seen = scratch.far_seen.data();
            for (std::size_t c = 0; c < kMotionBlock; ++c) {
                query.groups = block.groups.data() + block.first_group[c];
                query.group_count = block.first_group[c + 1] - block.first_group[c];
                if (query.group_count == 0) continue;
                const std::size_t cluster = b * kMotionBlock + c;
                query.centre = centres.record(cluster);
                query.centre_points = std::min(kClusterSize, centres.size() - cluster * kClusterSize);
                prune_to_reach(query);
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
                for (const Index j : block.nearby) {
                    if (total.is_longer(b, j, skin_)) open.push_back(j);
                    if (!block.is_whole && recent.is_longer(b, j, inner_skin_)) block.bring_back();
                }
                here.whole_blocks += block.is_whole;
                if (open.empty()) continue;
                if (++here.open_blocks > most_open) {
                    here.is_lost = true;
                    return here;
                }
                mend_block(block, b, centres, neighbours, open, reach);
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
                    const std::size_t i = (b * kMotionBlock + c) * kClusterSize + k / kClusterSize;
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
    const PairBlock<S>& block = blocks_[centre_cluster / kMotionBlock];
    const std::size_t c = centre_cluster % kMotionBlock;
    return block.first_group[c] < block.first_group[c + 1];
}

template <class S>
std::size_t PairList<S>::entries() const {
    std::size_t count = 0;
    for (const PairBlock<S>& block : blocks_)
        for (const PairGroup& group : block.groups) count += group.end - group.begin;
    return count;
}

template <class S>
std::size_t PairList<S>::bytes() const {
    std::size_t bytes = blocks_.capacity() * sizeof(PairBlock<S>);
    for (const PairBlock<S>& block : blocks_)
        bytes += block.groups.capacity() * sizeof(PairGroup) + block.ways.capacity() * sizeof(PairWay<S>) +
                 block.entries.capacity() * sizeof(PairEntry) + block.nearby.capacity() * sizeof(Index) +
                 block.seen.capacity() * sizeof(std::uint16_t);
    return bytes;
}

template class PairList<float>;
template class PairList<double>;

}  // namespace headrace::solver
