// The pair loop, written once: a pass says which fields it reads, what a pair contributes and where the sum goes.
// Compiled for each instruction set (Highway's foreach_target).
//
// A vector holds the pairs of some of a centre cluster's points with the four points of a neighbour's: neither gathers
// nor remainders. Every centre sums over its full neighbourhood in the order of its list, so no thread writes where
// another does and the sums are the same for any number of threads.
//
// A Pass has
//   kReadsWalls                     whether it sums over wall particles, too
//   kIsOfWalls                      whether its centres are wall particles, most of which may have no neighbours
//   kFluidFields, fluid_fields()    what pair() reads of a neighbour in the fluid, beside x and V
//   kWallFields, wall_fields()      the same of the walls
//   kFirstOwn, kOwnFields           which of the fluid's it reads of the centre, too: so many from that one on
//   kCentreFields, centre_fields()  what it reads of the centre alone, arrays in single precision; behind those
//   Sums<T>                         accumulators, made of T alone, starting at 0
//   pair<IsWall>(self, pair, neighbour, sums)   self(f), neighbour(f): field f, a T each
//   store(i, sums)                  what becomes of the sums of centre i
#include <type_traits>

#include "server/solver/pair.h"
#include "server/solver/pairs/lane_loads-inl.h"
#include "server/solver/pairs/pair_list.h"
#include "server/solver/parallel.h"

#if defined(HEADRACE_PAIRS_PAIR_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEADRACE_PAIRS_PAIR_SUMS_INL_H
#undef HEADRACE_PAIRS_PAIR_SUMS_INL_H
#else
#define HEADRACE_PAIRS_PAIR_SUMS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace headrace::solver::HWY_NAMESPACE {

// One kind of neighbours, with the list that leads to them.
template <class S>
struct NeighbourSource {
    const PairList<S>* list{};  // null: none
    const ClusterPoints<S>* points{};
    const S* fields{};
};

// Some of the points of a centre's cluster, and the neighbours that its entries lead to.
template <int D, class S>
struct CentreSight {
    using T = PairLanes<S>;

    std::array<T, D> x;
    const PairWay<S>* ways;
    const S* records;  // of all neighbours

    CentreSight(const S* record, std::size_t first_point, const PairWay<S>* ways_of_row, const S* of_neighbours)
        : ways(ways_of_row), records(of_neighbours) {
        for (int k = 0; k < D; ++k) x[k] = spread_four<S>(record + 4 * k + first_point);
    }

    HWY_INLINE std::size_t cluster(PairEntry entry) const {
        return std::size_t{ways[way_of(entry)].first} + place_of(entry);
    }
    HWY_INLINE Pair<D, T> meet(PairEntry entry) const {
        const PairWay<S>& way = ways[way_of(entry)];
        const S* record = records + cluster(entry) * (4 * (D + 1));
        Pair<D, T> pair;
        for (int k = 0; k < D; ++k) pair.x_ij[k] = (x[k] + load_one<S>(&way.offset[k])) - load_four<S>(record + 4 * k);
        pair.r2 = squared_distance<D, T>(pair.x_ij);
        pair.r = square_root<S>(pair.r2);
        pair.V_j = load_four<S>(record + 4 * D);
        return pair;
    }
};

template <std::size_t Fields, class S>
HWY_INLINE FieldsOf<PairLanes<S>, Fields> load_fields(const S* of_cluster) {
    FieldsOf<PairLanes<S>, Fields> loaded;
    if constexpr (Fields == 0) loaded = {};
    for (std::size_t f = 0; f < Fields; ++f) loaded.field[f] = load_four<S>(of_cluster + 4 * f);
    return loaded;
}

// Adds the pairs of a centre cluster's points with one kind of neighbours. IsHidden: some may not interact.
template <bool IsWall, bool IsHidden, int D, std::size_t Fields, class S, class Pass, class Self>
HWY_INLINE void add_pairs(const Pass& pass, const Self& self, const S* record, std::size_t first_point,
                          const PairBlock<S>& block, std::size_t c, const NeighbourSource<S>& source,
                          typename Pass::template Sums<PairLanes<S>>& sums) {
    using T = PairLanes<S>;
    const PairRow row = block.rows[c];
    if (row.begin == row.end) return;  // walls out of reach
    const PairEntry* const entries = block.entries.data();
    const CentreSight<D, S> sight(record, first_point, block.ways.data() + row.ways, source.points->record(0));
    const auto meet = [&](Index e) {
        Pair<D, T> pair = sight.meet(entries[e]);
        if constexpr (IsHidden) {
            // Rare, beside thin panels: hidden neighbours have no volume.
            alignas(64) S seen[T::kCount];
            for (std::size_t l = 0; l < T::kCount; ++l)
                seen[l] = static_cast<S>((block.seen[e] >> (4 * first_point + l)) & 1u);
            T weight;
            __builtin_memcpy(&weight.v, seen, sizeof weight.v);
            pair.V_j *= weight;
        }
        return pair;
    };
    // One ahead, where there are registers enough: the square root takes as long as the rest.
    constexpr bool kIsAhead = HWY_TARGET == HWY_AVX3;
    Pair<D, T> next;
    if constexpr (kIsAhead) next = meet(row.begin);
    for (Index e = row.begin; e < row.end; ++e) {
        const Pair<D, T> pair = kIsAhead ? next : meet(e);
        if constexpr (kIsAhead) {
            if (e + 1 < row.end) next = meet(e + 1);
        }
        const auto neighbour = load_fields<Fields, S>(source.fields + sight.cluster(entries[e]) * (4 * Fields));
        pass.template pair<IsWall>(self, pair, neighbour, sums);
    }
}

// The pass for the centres of one block of the lists.
template <int D, class S, class Pass>
HWY_NOINLINE void sum_block(const Pass& pass, const ClusterPoints<S>& centres, const NeighbourSource<S>& fluid,
                            const NeighbourSource<S>& walls, std::size_t b) {
    using T = PairLanes<S>;
    using LaneSums = typename Pass::template Sums<T>;
    using PointSums = typename Pass::template Sums<double>;
    constexpr std::size_t kAtOnce = T::kCount / 4;
    constexpr std::size_t kSums = sizeof(PointSums) / sizeof(double);
    static_assert(sizeof(LaneSums) == kSums * sizeof(T), "Sums has members of its number type only");

    [[maybe_unused]] const auto centre_fields = pass.centre_fields();
    const std::size_t first = b * kBlockClusters, last = std::min(first + kBlockClusters, centres.clusters());
    for (std::size_t c = first; c < last; ++c) {
        const std::size_t begin = c * kClusterSize, points = std::min(kClusterSize, centres.size() - begin);
        const PairBlock<S>& block = fluid.list->blocks()[b];
        if (Pass::kIsOfWalls && block.rows[c - first].begin == block.listed_end(c - first)) {
            for (std::size_t l = 0; l < points; ++l) pass.store(static_cast<Index>(begin + l), PointSums{});
            continue;
        }
        for (std::size_t part = 0; part < points; part += kAtOnce) {
            const S* const record = centres.record(c);
            FieldsOf<T, Pass::kOwnFields + Pass::kCentreFields> self;
            for (std::size_t f = 0; f < Pass::kOwnFields; ++f) {
                const std::size_t field = c * Pass::kFluidFields + Pass::kFirstOwn + f;
                self.field[f] = spread_four<S>(fluid.fields + 4 * field + part);
            }
            for (std::size_t f = 0; f < Pass::kCentreFields; ++f) {
                std::array<float, kClusterSize> four{};
                const float* own = centre_fields[f] + begin;
                if (points < kClusterSize) {
                    std::copy_n(own, points, four.begin());
                    own = four.data();
                }
                self.field[Pass::kOwnFields + f] = spread_four<S>(own + part);
            }
            LaneSums sums{};
            if (block.seen.empty())
                add_pairs<false, false, D, Pass::kFluidFields, S>(pass, self, record, part, block, c - first, fluid,
                                                                  sums);
            else
                add_pairs<false, true, D, Pass::kFluidFields, S>(pass, self, record, part, block, c - first, fluid,
                                                                 sums);
            if constexpr (Pass::kReadsWalls) {
                if (walls.list != nullptr) {
                    const PairBlock<S>& of_walls = walls.list->blocks()[b];
                    if (of_walls.seen.empty())
                        add_pairs<true, false, D, Pass::kWallFields, S>(pass, self, record, part, of_walls, c - first,
                                                                        walls, sums);
                    else
                        add_pairs<true, true, D, Pass::kWallFields, S>(pass, self, record, part, of_walls, c - first,
                                                                       walls, sums);
                }
            }
            // One by one: all at once would be copied word by word and read back before it has arrived.
            alignas(64) S lanes[kSums][T::kCount];
            for (std::size_t s = 0; s < kSums; ++s) {
                T four;
                __builtin_memcpy(&four.v, reinterpret_cast<const char*>(&sums) + s * sizeof(T), sizeof four.v);
                sum_fours<S>(four);
                __builtin_memcpy(lanes[s], &four.v, sizeof four.v);
            }
            for (std::size_t l = 0; l < kAtOnce && part + l < points; ++l) {
                std::array<double, kSums> total;
                for (std::size_t s = 0; s < kSums; ++s) total[s] = static_cast<double>(lanes[s][4 * l]);
                PointSums point;
                __builtin_memcpy(static_cast<void*>(&point), total.data(), sizeof point);
                pass.store(static_cast<Index>(begin + part + l), point);
            }
        }
    }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace headrace::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
