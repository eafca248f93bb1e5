// The pair loop over a half list: each pair once, for both of its points. Compiled for each instruction set (Highway's
// foreach_target).
//
// What the first point of a pair gets is summed in registers, what the second gets is added to its sums in memory.
// Blocks are taken in the order of their colours: every point's sums are formed in one order for any number of threads.
//
// A Pass has what pair_sums-inl.h asks for, walls and pair() left out, and
//   Sums<T>                                      of the first points
//   Change<T>                                    an array of T: what becomes of a point
//   exchange(self, pair, V_i, neighbour, sums)   adds what the pair contributes to its first point; returns what its
//                                                second loses
//   gain(self, sums)                             of the first points
//   store(i, change)
#include <algorithm>
#include <array>
#include <tuple>

#include "server/solver/pairs/block_colours.h"
#include "server/solver/pairs/pair_sums-inl.h"

#if defined(HEADRACE_PAIRS_HALF_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEADRACE_PAIRS_HALF_SUMS_INL_H
#undef HEADRACE_PAIRS_HALF_SUMS_INL_H
#else
#define HEADRACE_PAIRS_HALF_SUMS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace headrace::solver::HWY_NAMESPACE {

// Sums are added four at a time.
inline constexpr std::size_t in_fours(std::size_t sums) {
    return (sums + 3) / 4 * 4;
}

// Number j: the sum of lanes j, j + 4, ...
template <class S>
HWY_INLINE typename Lanes<S, 4>::Vector fold_columns(const PairLanes<S>& sum) {
    if constexpr (PairLanes<S>::kCount == 8) {
#if HWY_TARGET == HWY_AVX2
        // Not a shuffle of the vector with itself, as the compiler makes of the same in its own vectors: eight times as
        // many operations on the first cores of the kind.
        const auto v = (__m256)sum.v;
        return (typename Lanes<S, 4>::Vector)_mm_add_ps(_mm256_castps256_ps128(v), _mm256_extractf128_ps(v, 1));
#else
        return __builtin_shufflevector(sum.v, sum.v, 0, 1, 2, 3) + __builtin_shufflevector(sum.v, sum.v, 4, 5, 6, 7);
#endif
    } else {
        static_assert(PairLanes<S>::kCount == 4);
        return sum.v;
    }
}

// Takes from the four numbers of each sum: number j loses lanes j, j + 4, ...
template <class S, std::size_t N>
HWY_INLINE void take_columns(S* numbers, const std::array<PairLanes<S>, N>& sums) {
    if constexpr (PairLanes<S>::kCount == 16) {
#if HWY_TARGET == HWY_AVX3
        // Halves first, of two sums in one vector, then quarters, of all four.
        const auto halves = [](const PairLanes<S>& a, const PairLanes<S>& b) HWY_ATTR {
            const auto u = (__m512d)a.v, v = (__m512d)b.v;
            const __m512d low = _mm512_insertf64x4(u, _mm512_castpd512_pd256(v), 1);
            return _mm512_add_ps((__m512)low, (__m512)_mm512_shuffle_f64x2(u, v, 0xee));
        };
        for (std::size_t s = 0; s < N; s += 4, numbers += 4 * kClusterSize) {
            const auto sum = [&](std::size_t k) HWY_ATTR { return k < N ? sums[k] : PairLanes<S>(0.0); };
            const __m512 ab = halves(sum(s), sum(s + 1)), cd = halves(sum(s + 2), sum(s + 3));
            const __m512 all = _mm512_add_ps(_mm512_shuffle_f32x4(ab, cd, 0x88), _mm512_shuffle_f32x4(ab, cd, 0xdd));
            _mm512_store_ps(numbers, _mm512_sub_ps(_mm512_load_ps(numbers), all));
        }
#endif
    } else {
        using Four = Lanes<S, 4>::Vector;
        for (std::size_t s = 0; s < N; ++s, numbers += kClusterSize) {
            Four four;
            __builtin_memcpy(&four, numbers, sizeof four);
            four -= fold_columns<S>(sums[s]);
            __builtin_memcpy(numbers, &four, sizeof four);
        }
    }
}

// Adds to the numbers of each sum from `first` on: number i gets lanes 4 i to 4 i + 3.
template <class S, std::size_t N>
HWY_INLINE void add_rows(S* numbers, std::size_t first, std::array<PairLanes<S>, N> sums) {
#if HWY_TARGET == HWY_AVX3
    if constexpr (sizeof(S) == 4) {
        // Pairs of lanes first, of two sums in one vector, then fours, of all four: sum by sum within each point.
        const auto pairs = [](const __m512& a, const __m512& b) HWY_ATTR {
            return _mm512_add_ps(_mm512_shuffle_ps(a, b, 0x88), _mm512_shuffle_ps(a, b, 0xdd));
        };
        const __m512i transposed = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
        for (std::size_t s = 0; s < N; s += 4, numbers += 4 * kClusterSize) {
            const auto sum = [&](std::size_t k) HWY_ATTR { return k < N ? (__m512)sums[k].v : _mm512_setzero_ps(); };
            const __m512 all = pairs(pairs(sum(s), sum(s + 1)), pairs(sum(s + 2), sum(s + 3)));
            _mm512_store_ps(numbers, _mm512_add_ps(_mm512_load_ps(numbers), _mm512_permutexvar_ps(transposed, all)));
        }
        return;
    }
#endif
    for (std::size_t s = 0; s < N; ++s) {
        sum_fours<S>(sums[s]);
        for (std::size_t i = 0; i < PairLanes<S>::kCount / 4; ++i)
            numbers[s * kClusterSize + first + i] += sums[s].v[4 * i];
    }
}

// Sums over the half list among the fluid.
template <int D, class S>
class HalfSums {
    using T = PairLanes<S>;

  public:
    // list: half; colours: of its blocks; fields: what the pass reads of the points, packed.
    template <class Pass>
    void run(const Pass& pass, const ClusterPoints<S>& points, const PairList<S>& list, const BlockColours& colours,
             const S* fields) {
        using Change = typename Pass::template Change<double>;
        constexpr std::size_t kSums = std::tuple_size_v<Change>, kNumbers = in_fours(kSums) * kClusterSize;
        sums_.resize(points.clusters() * kNumbers);
        parallel_for(points.clusters(), kBlockClusters, [&](std::size_t first, std::size_t last, int) {
            std::fill(&sums_[0] + first * kNumbers, &sums_[0] + last * kNumbers, S{});
        });
        colours.for_each_block([&](std::size_t b) { add_block(pass, points, list.blocks()[b], b, fields); });
        parallel_for(points.size(), kBlockClusters * kClusterSize, [&](std::size_t first, std::size_t last, int) {
            for (std::size_t i = first; i < last; ++i) {
                const S* of_cluster = &sums_[0] + i / kClusterSize * kNumbers + i % kClusterSize;
                Change change;
                for (std::size_t s = 0; s < kSums; ++s) change[s] = static_cast<double>(of_cluster[s * kClusterSize]);
                pass.store(static_cast<Index>(i), change);
            }
        });
    }

  private:
    template <class Pass>
    HWY_NOINLINE void add_block(const Pass& shared_pass, const ClusterPoints<S>& points, const PairBlock<S>& block,
                                std::size_t b, const S* fields) {
        using LaneSums = typename Pass::template Sums<T>;
        using Change = typename Pass::template Change<T>;
        constexpr std::size_t kSums = std::tuple_size_v<Change>, kNumbers = in_fours(kSums) * kClusterSize;
        constexpr std::size_t kAtOnce = T::kCount / 4, kFields = Pass::kFluidFields;
        const Pass pass = shared_pass;  // which the sums written cannot change: its constants stay in registers
        const std::size_t first = b * kBlockClusters, last = std::min(first + kBlockClusters, points.clusters());
        S* const all_sums = &sums_[0];
        for (std::size_t c = first; c < last; ++c) {
            const PairRow row = block.rows[c - first];
            const Index count = row.end - row.begin;
            if (count == 0) continue;
            const PairEntry* const entries = block.entries.data() + row.begin;
            const S *const record = points.record(c), *const own_fields = fields + c * (4 * kFields);
            for (std::size_t part = 0; part < kClusterSize; part += kAtOnce) {
                const CentreSight<D, S> sight(record, part, block.ways.data() + row.ways, points.record(0));
                const T V_i = spread_four<S>(record + 4 * D + part);
                FieldsOf<T, kFields> self;
                for (std::size_t f = 0; f < kFields; ++f) self.field[f] = spread_four<S>(own_fields + 4 * f + part);
                LaneSums sums{};
                // The cluster with itself: each of its pairs is there both ways.
                pass.exchange(self, sight.meet(entries[0]), V_i, load_fields<kFields, S>(own_fields), sums);
                // One ahead: the square root takes as long as the rest.
                Pair<D, T> next;
                if (count > 1) next = sight.meet(entries[1]);
                for (Index e = 1; e < count; ++e) {
                    const Pair<D, T> pair = next;
                    if (e + 1 < count) next = sight.meet(entries[e + 1]);
                    const std::size_t cluster = sight.cluster(entries[e]);
                    const Change loss =
                        pass.exchange(self, pair, V_i, load_fields<kFields, S>(fields + cluster * (4 * kFields)), sums);
                    take_columns<S, kSums>(all_sums + cluster * kNumbers, loss);
                }
                add_rows<S, kSums>(all_sums + c * kNumbers, part, pass.gain(self, sums));
            }
        }
    }

    AlignedArray<S> sums_;  // [cluster][sum][point]
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace headrace::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
