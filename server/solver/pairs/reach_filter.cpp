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
            for (int k = 0; k < D; ++k) there.x_[part][k] += T(static_cast<double>(offset[k]));
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

template <class S, int D>
void filter(const ReachQuery<S>& query, Index* found, Index* end_of_way) {
    const CentreLanes<S, D> centre(query.centre, query.centre_points);
    const PairLanes<S> reach2(query.reach * query.reach);
    std::size_t written = 0, c = 0;
    for (std::size_t w = 0; w < query.way_count; ++w) {
        const CandidateWay<S>& way = query.ways[w];
        const CentreLanes<S, D> x = centre.displaced(way.way.offset);
        for (; c < query.count && query.kept[c] < way.end; ++c) {
            const Index cluster = query.clusters[query.kept[c]];
            found[written] = cluster;
            written += x.is_within(reach2, query.records + cluster * std::size_t{4 * (D + 1)});
        }
        end_of_way[w] = static_cast<Index>(written);
    }
}

template <class S, int D, bool HasSeen>
void prune(const PruneQuery<S>& query) {
    const CentreLanes<S, D> centre(query.centre, query.centre_points);
    const PairLanes<S> reach2(query.reach * query.reach);
    for (std::size_t g = 0; g < query.group_count; ++g) {
        PairGroup& group = query.groups[g];
        const PairWay<S>& way = query.ways[group.way];
        const CentreLanes<S, D> x = centre.displaced(way.offset);
        constexpr std::size_t kRecord = 4 * (D + 1);
        const S* const page = query.records + way.page * kRecord;
        const Index listed_end = query.groups[g + 1].begin;
        Index near = group.begin, far = 0;
        for (Index e = group.begin; e < listed_end; ++e) {
            const PairEntry entry = query.entries[e];
            const bool is_near = x.is_within(reach2, page + entry * kRecord);
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
        group.end = near;
        std::copy(query.far, query.far + far, query.entries + near);
        if constexpr (HasSeen) std::copy(query.far_seen, query.far_seen + far, query.seen + near);
    }
}

template <class S>
void prune_any(const PruneQuery<S>& query) {
    if (query.dimensions == 2) {
        query.seen == nullptr ? prune<S, 2, false>(query) : prune<S, 2, true>(query);
    } else {
        query.seen == nullptr ? prune<S, 3, false>(query) : prune<S, 3, true>(query);
    }
}

// Longer than the reach by this share: places are rounded to float.
constexpr double kRounding = 1e-4;

template <int D>
std::size_t boxes_within(const BoxQuery& query, Index* kept) {
    const hn::CappedTag<float, BoxQuery::kPadding> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    static_assert(sizeof(Index) == sizeof(hn::TFromD<decltype(du)>));
    std::array<hn::Vec<decltype(d)>, D> centre, half;
    for (int k = 0; k < D; ++k) {
        centre[k] = hn::Set(d, query.box.centre[k]);
        half[k] = hn::Set(d, query.box.half[k]);
    }
    const auto reach2 = hn::Set(d, static_cast<float>(query.reach * query.reach * (1.0 + 2.0 * kRounding)));
    const auto zero = hn::Zero(d);
    std::size_t count = 0;
    for (std::size_t k = 0; k < query.count; k += hn::Lanes(d)) {
        auto gap2 = zero;
        for (int a = 0; a < D; ++a) {
            const auto apart = hn::Abs(hn::Sub(hn::Load(d, query.centre[a] + k), centre[a]));
            const auto gap = hn::Max(zero, hn::Sub(apart, hn::Add(hn::Load(d, query.half[a] + k), half[a])));
            gap2 = hn::MulAdd(gap, gap, gap2);
        }
        const auto numbers = hn::Iota(du, static_cast<Index>(k));
        const auto is_near = hn::RebindMask(du, hn::Le(gap2, reach2));
        // Compressing into memory is slow on some machines.
        hn::StoreU(hn::Compress(numbers, is_near), du, kept + count);
        count += hn::CountTrue(du, is_near);
    }
    while (count > 0 && kept[count - 1] >= query.count) --count;  // the padding
    return count;
}

std::size_t filter_boxes_of(const BoxQuery& query, Index* kept) {
    return query.dimensions == 2 ? boxes_within<2>(query, kept) : boxes_within<3>(query, kept);
}

void filter_float(const ReachQuery<float>& query, Index* found, Index* end_of_way) {
    query.dimensions == 2 ? filter<float, 2>(query, found, end_of_way) : filter<float, 3>(query, found, end_of_way);
}
void filter_double(const ReachQuery<double>& query, Index* found, Index* end_of_way) {
    query.dimensions == 2 ? filter<double, 2>(query, found, end_of_way) : filter<double, 3>(query, found, end_of_way);
}

void prune_float(const PruneQuery<float>& query) {
    prune_any(query);
}
void prune_double(const PruneQuery<double>& query) {
    prune_any(query);
}

}  // namespace headrace::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace headrace::solver {

HWY_EXPORT(filter_boxes_of);
HWY_EXPORT(filter_float);
HWY_EXPORT(filter_double);
HWY_EXPORT(prune_float);
HWY_EXPORT(prune_double);

std::size_t filter_boxes(const BoxQuery& query, Index* kept) {
    return HWY_DYNAMIC_DISPATCH(filter_boxes_of)(query, kept);
}

void filter_reach(const ReachQuery<float>& query, Index* found, Index* end_of_way) {
    HWY_DYNAMIC_DISPATCH(filter_float)(query, found, end_of_way);
}
void filter_reach(const ReachQuery<double>& query, Index* found, Index* end_of_way) {
    HWY_DYNAMIC_DISPATCH(filter_double)(query, found, end_of_way);
}

void prune_to_reach(const PruneQuery<float>& query) {
    HWY_DYNAMIC_DISPATCH(prune_float)(query);
}
void prune_to_reach(const PruneQuery<double>& query) {
    HWY_DYNAMIC_DISPATCH(prune_double)(query);
}

}  // namespace headrace::solver
#endif
