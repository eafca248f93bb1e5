#include "server/solver/pairs/reach_filter.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/solver/pairs/reach_filter.cpp"
#include "hwy/foreach_target.h"
// After it, since they are compiled for each target.
#include "server/solver/pairs/lane_loads-inl.h"

HWY_BEFORE_NAMESPACE();
namespace headrace::solver::HWY_NAMESPACE {

// The points of a centre's cluster, as many vectors as it takes.
template <class S, int D>
class CentreLanes {
    using T = PairLanes<S>;

  public:
    // Points that are not there are put where the first is.
    CentreLanes(const S* record, std::size_t points) {
        for (int k = 0; k < D; ++k) {
            std::array<S, 4> four;
            for (std::size_t l = 0; l < 4; ++l) four[l] = record[4 * k + (l < points ? l : 0)];
            for (std::size_t part = 0; part < kParts; ++part) x_[part][k] = spread_four<S>(&four[part * kAtOnce]);
        }
    }

    HWY_INLINE CentreLanes displaced(const std::array<S, 3>& offset) const {
        CentreLanes there = *this;
        for (std::size_t part = 0; part < kParts; ++part)
            for (int k = 0; k < D; ++k) there.x_[part][k] += load_one<S>(&offset[k]);
        return there;
    }

    // Bit k: is any of them within reach k of one of the four points?
    template <std::size_t N>
    HWY_INLINE unsigned within(const std::array<T, N>& reach2, const S* record) const {
        unsigned near = 0;
        for (std::size_t part = 0; part < kParts; ++part) {
            T r2(0.0);
            for (int k = 0; k < D; ++k) {
                const T x_ij = x_[part][k] - load_four<S>(record + 4 * k);
                r2 += x_ij * x_ij;
            }
            for (std::size_t k = 0; k < N; ++k) near |= unsigned{is_any_below<S>(r2, reach2[k])} << k;
        }
        return near;
    }

  private:
    static constexpr std::size_t kAtOnce = T::kCount / 4, kParts = 4 / kAtOnce;
    std::array<std::array<T, D>, kParts> x_;
};

// Longer than the reach by this share: places are rounded to float.
constexpr double kRounding = 1e-4;

// A centre's box against the clusters of one way, some at once.
template <int D>
class BoxLanes {
    using Vector = hn::Vec<hn::CappedTag<float, kBlockClusters>>;

  public:
    static constexpr hn::CappedTag<float, kBlockClusters> d{};

    BoxLanes(const ClusterBox& box, const WaySight& sight) : boxes_(*sight.boxes) {
        for (int a = 0; a < D; ++a) {
            low_[a] = hn::Set(d, box.low[a] + sight.down[a]);
            high_[a] = hn::Set(d, box.high[a] + sight.up[a]);
        }
    }

    // Which of them from `first` on are within reach of the box?
    HWY_INLINE hn::Mask<decltype(d)> near(std::size_t first, const Vector& reach2) const {
        auto gap2 = hn::Zero(d);
        for (int a = 0; a < D; ++a) {
            const auto below = hn::Sub(hn::LoadU(d, &boxes_.low[a][first]), high_[a]);
            const auto above = hn::Sub(low_[a], hn::LoadU(d, &boxes_.high[a][first]));
            const auto gap = hn::Max(hn::Zero(d), hn::Max(below, above));
            gap2 = hn::MulAdd(gap, gap, gap2);
        }
        return hn::Le(gap2, reach2);
    }

    static Vector square_of(double reach) {
        return hn::Set(d, static_cast<float>(reach * reach * (1.0 + 2.0 * kRounding)));
    }

  private:
    const BlockBoxes& boxes_;
    std::array<Vector, D> low_, high_;
};

template <int D>
std::size_t ways_within(const WayQuery& query, Index* kept) {
    const auto reach2 = BoxLanes<D>::square_of(query.reach);
    std::size_t count = 0;
    for (std::size_t w = 0; w < query.count; ++w) {
        const BoxLanes<D> box(query.box, query.sights[w]);
        bool is_near = false;
        for (std::size_t first = 0; first < kBlockClusters; first += hn::Lanes(box.d))
            is_near |= !hn::AllFalse(box.d, box.near(first, reach2));
        kept[count] = static_cast<Index>(w);
        count += is_near;
    }
    return count;
}

// Writes first + k for each lane k of the mask, ascending; returns how many. There must be space for all lanes.
template <class D32, class Mask>
HWY_INLINE std::size_t store_numbers(D32 d, Mask mask, Index first, Index* numbers) {
    if constexpr (hn::MaxLanes(d) > 8) {
        // Iota is put together number by number. Compressing into memory is slow on some machines.
        alignas(64) static constexpr std::array<Index, 16> kLanes{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
        const hn::RebindToUnsigned<D32> du;
        const auto all = hn::Add(hn::Load(du, kLanes.data()), hn::Set(du, first));
        hn::StoreU(hn::Compress(all, hn::RebindMask(du, mask)), du, numbers);
        return hn::CountTrue(d, mask);
    } else {
        // Compress looks its permutation up; in AVX2 it copies the table of 1 KiB each time.
        std::array<std::uint8_t, 8> bits{};
        hn::StoreMaskBits(d, mask, bits.data());
        std::size_t count = 0;
        for (Index k = 0; k < hn::Lanes(d); ++k) {
            numbers[count] = first + k;
            count += bits[0] >> k & 1u;
        }
        return count;
    }
}

// Writes the numbers of the clusters whose boxes are within reach; returns how many.
template <class S, int D>
std::size_t boxes_within(const NearQuery<S>& query, Index* maybe) {
    const auto d = BoxLanes<D>::d;
    const auto reach2 = BoxLanes<D>::square_of(query.reach);
    const ClusterBox centre = query.box;  // a copy, which no store can change: it stays in registers
    std::size_t count = 0;
    Index number = 0;
    for (std::size_t w = 0; w < query.way_count; ++w) {
        const BoxLanes<D> box(centre, query.sights[w]);
        for (std::size_t first = 0; first < kBlockClusters; first += hn::Lanes(d)) {
            count += store_numbers(d, box.near(first, reach2), number, maybe + count);
            number += static_cast<Index>(hn::Lanes(d));
        }
    }
    return count;
}

// Boxes decide first.
template <class S, int D>
ListedEntries list_within(const NearQuery<S>& query, PairEntry* found) {
    const std::size_t count = boxes_within<S, D>(query, query.maybe);
    const CentreLanes<S, D> centre(query.centre, query.centre_points);
    const std::array reach2{PairLanes<S>(query.inner_reach * query.inner_reach),
                            PairLanes<S>(query.reach * query.reach)};
    constexpr std::size_t kRecord = 4 * (D + 1);
    std::size_t near = 0, far = 0, n = 0;
    while (n < count && query.maybe[n] < query.skipped) ++n;
    for (; n < count; ++n) {
        const auto entry = static_cast<PairEntry>(query.maybe[n]);
        const PairWay<S>& way = query.ways[way_of(entry)];
        const unsigned within =
            centre.displaced(way.offset).within(reach2, query.records + (way.first + place_of(entry)) * kRecord);
        found[near] = entry;
        query.far[far] = entry;
        near += within & 1u;
        far += (within >> 1) & ~within & 1u;
    }
    std::copy(query.far, query.far + far, found + near);
    return {near, near + far};
}

template <class S, int D, bool HasSeen>
std::size_t prune(const PruneQuery<S>& query) {
    const CentreLanes<S, D> centre(query.centre, query.centre_points);
    const std::array reach2{PairLanes<S>(query.reach * query.reach)};
    constexpr std::size_t kRecord = 4 * (D + 1);
    std::size_t near = 0, far = 0;
    for (std::size_t e = 0; e < query.count; ++e) {
        const PairEntry entry = query.entries[e];
        const PairWay<S>& way = query.ways[way_of(entry)];
        const bool is_near =
            centre.displaced(way.offset).within(reach2, query.records + (way.first + place_of(entry)) * kRecord) != 0;
        query.far[far] = entry;
        query.entries[near] = entry;
        if constexpr (HasSeen) {
            const std::uint16_t seen = query.seen[e];
            query.far_seen[far] = seen;
            query.seen[near] = seen;
        }
        near += is_near;
        far += !is_near;
    }
    std::copy(query.far, query.far + far, query.entries + near);
    if constexpr (HasSeen) std::copy(query.far_seen, query.far_seen + far, query.seen + near);
    return near;
}

template <class S>
std::size_t prune_any(const PruneQuery<S>& query) {
    if (query.dimensions == 2) return query.seen == nullptr ? prune<S, 2, false>(query) : prune<S, 2, true>(query);
    return query.seen == nullptr ? prune<S, 3, false>(query) : prune<S, 3, true>(query);
}

std::size_t filter_ways_of(const WayQuery& query, Index* kept) {
    return query.dimensions == 2 ? ways_within<2>(query, kept) : ways_within<3>(query, kept);
}

ListedEntries list_near_float(const NearQuery<float>& query, PairEntry* found) {
    return query.dimensions == 2 ? list_within<float, 2>(query, found) : list_within<float, 3>(query, found);
}
ListedEntries list_near_double(const NearQuery<double>& query, PairEntry* found) {
    return query.dimensions == 2 ? list_within<double, 2>(query, found) : list_within<double, 3>(query, found);
}

std::size_t prune_float(const PruneQuery<float>& query) {
    return prune_any(query);
}
std::size_t prune_double(const PruneQuery<double>& query) {
    return prune_any(query);
}

}  // namespace headrace::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace headrace::solver {

HWY_EXPORT(filter_ways_of);
HWY_EXPORT(list_near_float);
HWY_EXPORT(list_near_double);
HWY_EXPORT(prune_float);
HWY_EXPORT(prune_double);

std::size_t filter_ways(const WayQuery& query, Index* kept) {
    return HWY_DYNAMIC_DISPATCH(filter_ways_of)(query, kept);
}

ListedEntries list_near(const NearQuery<float>& query, PairEntry* found) {
    return HWY_DYNAMIC_DISPATCH(list_near_float)(query, found);
}
ListedEntries list_near(const NearQuery<double>& query, PairEntry* found) {
    return HWY_DYNAMIC_DISPATCH(list_near_double)(query, found);
}

std::size_t prune_to_reach(const PruneQuery<float>& query) {
    return HWY_DYNAMIC_DISPATCH(prune_float)(query);
}
std::size_t prune_to_reach(const PruneQuery<double>& query) {
    return HWY_DYNAMIC_DISPATCH(prune_double)(query);
}

}  // namespace headrace::solver
#endif
