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

    // Is any of them near one of the four points?
    HWY_INLINE bool is_within(const T& reach2, const S* record) const {
        bool is_near = false;
        for (std::size_t part = 0; part < kParts; ++part) {
            T r2(0.0);
            for (int k = 0; k < D; ++k) {
                const T x_ij = x_[part][k] - load_four<S>(record + 4 * k);
                r2 += x_ij * x_ij;
            }
            is_near |= is_any_below<S>(r2, reach2);
        }
        return is_near;
    }

  private:
    static constexpr std::size_t kAtOnce = T::kCount / 4, kParts = 4 / kAtOnce;
    std::array<std::array<T, D>, kParts> x_;
};

// Longer than the reach by this share: places are rounded to float.
constexpr double kRounding = 1e-4;

// The clusters of one way against a box, some at once.
template <int D>
class BoxLanes {
  public:
    static constexpr hn::CappedTag<float, kBlockClusters> d{};

    BoxLanes(const ClusterBox& box, double reach)
        : reach2_(hn::Set(d, static_cast<float>(reach * reach * (1.0 + 2.0 * kRounding)))) {
        for (int a = 0; a < D; ++a) {
            low_[a] = hn::Set(d, box.low[a]);
            high_[a] = hn::Set(d, box.high[a]);
        }
    }

    // Which of them from `first` on are within reach of the box?
    HWY_INLINE hn::Mask<hn::CappedTag<float, kBlockClusters>> near(const WaySight& sight, std::size_t first) const {
        auto gap2 = hn::Zero(d);
        for (int a = 0; a < D; ++a) {
            const auto high = hn::Add(high_[a], hn::Set(d, sight.up[a])),
                       low = hn::Add(low_[a], hn::Set(d, sight.down[a]));
            const auto below = hn::Sub(hn::LoadU(d, &sight.boxes->low[a][first]), high);
            const auto above = hn::Sub(low, hn::LoadU(d, &sight.boxes->high[a][first]));
            const auto gap = hn::Max(hn::Zero(d), hn::Max(below, above));
            gap2 = hn::MulAdd(gap, gap, gap2);
        }
        return hn::Le(gap2, reach2_);
    }

  private:
    std::array<hn::Vec<hn::CappedTag<float, kBlockClusters>>, D> low_, high_;
    hn::Vec<hn::CappedTag<float, kBlockClusters>> reach2_;
};

template <int D>
std::size_t ways_within(const WayQuery& query, Index* kept) {
    const BoxLanes<D> box(query.box, query.reach);
    std::size_t count = 0;
    for (std::size_t w = 0; w < query.count; ++w) {
        bool is_near = false;
        for (std::size_t first = 0; first < kBlockClusters; first += hn::Lanes(box.d))
            is_near |= !hn::AllFalse(box.d, box.near(query.sights[w], first));
        kept[count] = static_cast<Index>(w);
        count += is_near;
    }
    return count;
}

// Boxes decide first.
template <class S, int D>
std::size_t list_within(const NearQuery<S>& query, PairEntry* found) {
    const BoxLanes<D> box(query.box, query.reach);
    const hn::RebindToUnsigned<decltype(box.d)> du;
    static_assert(sizeof(Index) == sizeof(hn::TFromD<decltype(du)>));
    // Iota is put together number by number.
    alignas(64) static constexpr std::array<Index, kBlockClusters> kPlaces{0, 1, 2,  3,  4,  5,  6,  7,
                                                                           8, 9, 10, 11, 12, 13, 14, 15};
    auto numbers = hn::Load(du, kPlaces.data());
    const auto next = hn::Set(du, static_cast<Index>(hn::Lanes(du)));
    std::size_t count = 0;
    for (std::size_t w = 0; w < query.way_count; ++w) {
        for (std::size_t first = 0; first < kBlockClusters;
             first += hn::Lanes(box.d), numbers = hn::Add(numbers, next)) {
            const auto is_near = hn::RebindMask(du, box.near(query.sights[w], first));
            // Compressing into memory is slow on some machines.
            hn::StoreU(hn::Compress(numbers, is_near), du, query.maybe + count);
            count += hn::CountTrue(du, is_near);
        }
    }
    const CentreLanes<S, D> centre(query.centre, query.centre_points);
    const PairLanes<S> reach2(query.reach * query.reach);
    constexpr std::size_t kRecord = 4 * (D + 1);
    std::size_t written = 0, n = 0;
    while (n < count && query.maybe[n] < query.skipped) ++n;
    for (; n < count; ++n) {
        const auto entry = static_cast<PairEntry>(query.maybe[n]);
        const PairWay<S>& way = query.ways[way_of(entry)];
        found[written] = entry;
        written +=
            centre.displaced(way.offset).is_within(reach2, query.records + (way.first + place_of(entry)) * kRecord);
    }
    return written;
}

template <class S, int D, bool HasSeen>
std::size_t prune(const PruneQuery<S>& query) {
    const CentreLanes<S, D> centre(query.centre, query.centre_points);
    const PairLanes<S> reach2(query.reach * query.reach);
    constexpr std::size_t kRecord = 4 * (D + 1);
    std::size_t near = 0, far = 0;
    for (std::size_t e = 0; e < query.count; ++e) {
        const PairEntry entry = query.entries[e];
        const PairWay<S>& way = query.ways[way_of(entry)];
        const bool is_near =
            centre.displaced(way.offset).is_within(reach2, query.records + (way.first + place_of(entry)) * kRecord);
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

std::size_t list_near_float(const NearQuery<float>& query, PairEntry* found) {
    return query.dimensions == 2 ? list_within<float, 2>(query, found) : list_within<float, 3>(query, found);
}
std::size_t list_near_double(const NearQuery<double>& query, PairEntry* found) {
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

std::size_t list_near(const NearQuery<float>& query, PairEntry* found) {
    return HWY_DYNAMIC_DISPATCH(list_near_float)(query, found);
}
std::size_t list_near(const NearQuery<double>& query, PairEntry* found) {
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
