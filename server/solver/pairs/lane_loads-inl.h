// Loads and operations of Lanes that need instructions of their own, for the instruction set this file is compiled for.
// Included once per set (Highway's foreach_target).
#include "hwy/highway.h"
#include "server/solver/lanes.h"

#if defined(HEADRACE_PAIRS_LANE_LOADS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEADRACE_PAIRS_LANE_LOADS_INL_H
#undef HEADRACE_PAIRS_LANE_LOADS_INL_H
#else
#define HEADRACE_PAIRS_LANE_LOADS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace headrace::solver::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector holds the pairs of some of a cluster's four points with all four of another: four lanes at least, and not
// more than there are pairs.
#if HWY_TARGET == HWY_AVX3
template <class S>
inline constexpr std::size_t kPairLanes = 64 / sizeof(S);
#elif HWY_TARGET == HWY_AVX2
template <class S>
inline constexpr std::size_t kPairLanes = 32 / sizeof(S);
#else
template <class S>
inline constexpr std::size_t kPairLanes = 4;
#endif
template <class S>
using PairLanes = Lanes<S, kPairLanes<S>>;

// Four numbers, again and again.
template <class S>
HWY_INLINE PairLanes<S> load_four(const S* aligned) {
    PairLanes<S> lanes;
    constexpr std::size_t N = kPairLanes<S>;
    if constexpr (N == 4) {
        __builtin_memcpy(&lanes.v, __builtin_assume_aligned(aligned, 16), sizeof lanes.v);
    }
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
    else if constexpr (sizeof(S) == 4) {
        const hn::CappedTag<S, N> d;
        lanes.v = (typename PairLanes<S>::Vector)(hn::LoadDup128(d, aligned).raw);
    } else {
        const hn::CappedTag<S, N> d;
        const hn::Half<decltype(d)> half;
        const auto four = hn::Load(half, aligned);
        lanes.v = (typename PairLanes<S>::Vector)(hn::Combine(d, four, four).raw);
    }
#endif
    return lanes;
}

// One number in all lanes.
template <class S>
HWY_INLINE PairLanes<S> load_one(const S* number) {
    PairLanes<S> lanes;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
    const hn::CappedTag<S, kPairLanes<S>> d;
    if constexpr (kPairLanes<S> == hn::MaxLanes(d)) {
        lanes.v = (typename PairLanes<S>::Vector)(hn::Set(d, *number).raw);
        return lanes;
    }
#endif
    for (std::size_t k = 0; k < kPairLanes<S>; ++k) lanes.v[k] = *number;
    return lanes;
}

// The first number in the first four lanes, the second in the next four, ...
template <class S, class From>
HWY_INLINE PairLanes<S> spread_four(const From* numbers) {
#if HWY_TARGET == HWY_AVX3
    if constexpr (sizeof(S) == 4) {
        const hn::CappedTag<float, 16> d;
        const hn::CappedTag<float, 4> d4;
        alignas(64) static constexpr std::int32_t kEach[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
        hn::Vec<decltype(d4)> four;
        if constexpr (sizeof(From) == 4) {
            four = hn::LoadU(d4, numbers);
        } else {
            four = hn::DemoteTo(d4, hn::LoadU(hn::CappedTag<double, 4>(), numbers));
        }
        const hn::Vec<decltype(d)> low{_mm512_castps128_ps512(four.raw)};  // what is above it is not looked up
        PairLanes<S> lanes;
        lanes.v = (typename PairLanes<S>::Vector)(hn::TableLookupLanes(low, hn::SetTableIndices(d, kEach)).raw);
        return lanes;
    }
#endif
    alignas(64) S spread[kPairLanes<S>];
    for (std::size_t k = 0; k < kPairLanes<S>; ++k) spread[k] = static_cast<S>(numbers[k / 4]);
    PairLanes<S> lanes;
    __builtin_memcpy(&lanes.v, spread, sizeof lanes.v);
    return lanes;
}

// Is any a below b?
template <class S>
HWY_INLINE bool is_any_below(const PairLanes<S>& a, const PairLanes<S>& b) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
    const hn::CappedTag<S, kPairLanes<S>> d;
    hn::Vec<decltype(d)> u, v;
    u.raw = (decltype(u.raw))a.v;
    v.raw = (decltype(v.raw))b.v;
    return !hn::AllFalse(d, hn::Lt(u, v));
#else
    bool any = false;
    for (std::size_t k = 0; k < kPairLanes<S>; ++k) any |= a.v[k] < b.v[k];
    return any;
#endif
}

// The sum of each four lanes, in the first of them.
template <class S>
HWY_INLINE void sum_fours(PairLanes<S>& a) {
    constexpr std::size_t N = kPairLanes<S>;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
    if constexpr (sizeof(S) == 4 && N > 4) {
        const hn::CappedTag<S, N> d;
        hn::Vec<decltype(d)> vector;
        vector.raw = (decltype(vector.raw))a.v;
        vector = hn::Add(vector, hn::Shuffle2301(vector));
        vector = hn::Add(vector, hn::Shuffle1032(vector));
        a.v = (typename PairLanes<S>::Vector)(vector.raw);
        return;
    }
#endif
    for (std::size_t k = 0; k < N; k += 4) a.v[k] = (a.v[k] + a.v[k + 1]) + (a.v[k + 2] + a.v[k + 3]);
}

template <class S>
HWY_INLINE PairLanes<S> square_root(const PairLanes<S>& a) {
    PairLanes<S> root;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
    const hn::CappedTag<S, kPairLanes<S>> d;
    hn::Vec<decltype(d)> vector;
    vector.raw = (decltype(vector.raw))a.v;
    root.v = (typename PairLanes<S>::Vector)(hn::Sqrt(vector).raw);
#else
    for (std::size_t k = 0; k < kPairLanes<S>; ++k) root.v[k] = std::sqrt(a.v[k]);
#endif
    return root;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace headrace::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
