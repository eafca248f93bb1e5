// The strategies of speed_sums.h for the instruction set this file is compiled for.
#include <algorithm>
#include <chrono>

#include "server/solver/neighbours.h"
#include "server/solver/pairs/cluster_order.h"
#include "server/solver/pairs/half_sums-inl.h"
#include "server/solver/pairs/packed_fields-inl.h"
#include "server/solver/pairs/pair_neighbours.h"
#include "server/solver/pairs/pair_sums-inl.h"
#include "tests/bench/speed_clock.h"
#include "tests/bench/speed_sums.h"

#if defined(HEADRACE_BENCH_SPEED_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEADRACE_BENCH_SPEED_SUMS_INL_H
#undef HEADRACE_BENCH_SPEED_SUMS_INL_H
#else
#define HEADRACE_BENCH_SPEED_SUMS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace headrace::bench::HWY_NAMESPACE {

using solver::Index;
using solver::HWY_NAMESPACE::kPairLanes;
using solver::HWY_NAMESPACE::PairLanes;

// ---- clusters -------------------------------------------------------------------------------------------------------

template <int D, bool IsHalf>
class ClusterSums final : public PlainSums {
  public:
    void compute(PlainFluid& fluid, StageSeconds& seconds) override {
        StageClock clock;
        const bool covers = has_lists_ && neighbours_.move_fluid(fluid.x, fluid.V);
        seconds.list += clock.lap();
        if (!covers) {
            fields_.release();
            wrap_plain_fluid(fluid);
            order_.build(fluid.x, fluid.id, D, fluid.spacing, fluid.domain);
            permute_plain_fluid(fluid, order_);
            order_.forget_moves();
            seconds.sort += clock.lap();
            solver::NeighbourInput in;
            in.dimensions = D;
            in.fluid = {&order_, &fluid.x, fluid.V, fluid.size()};
            in.reach.support = fluid.support;
            in.reach.skin = kSkin * fluid.spacing;
            in.reach.inner_skin = kInnerSkin * fluid.spacing;
            in.reach.far_skins = 1.0;  // the vortex is smooth
            in.reach.period = fluid.domain.max;
            in.reach.is_half = IsHalf;
            neighbours_.find(in);
            if constexpr (IsHalf) colours_.build(neighbours_.among_fluid());
            has_lists_ = true;
            ++sorts_;
            seconds.list += clock.lap();
        }
        const PlainPass<D> pass(fluid);
        fields_.fill(pass.fluid_fields(), fluid.size());
        if constexpr (IsHalf) {
            half_sums_.run(pass, neighbours_.fluid(), neighbours_.among_fluid(), colours_, fields_.fluid());
            seconds.pair += clock.lap();
            return;
        }
        const solver::HWY_NAMESPACE::NeighbourSource<float> source{&neighbours_.among_fluid(), &neighbours_.fluid(),
                                                                   fields_.fluid()};
        solver::parallel_for(source.list->blocks().size(), 2, [&](std::size_t first, std::size_t last, int) {
            for (std::size_t b = first; b < last; ++b)
                solver::HWY_NAMESPACE::sum_block<D, float>(pass, neighbours_.fluid(), source, {}, b);
        });
        seconds.pair += clock.lap();
    }

    double candidates() const override { return neighbours_.neighbours_per_particle(); }
    long sorts() const override { return sorts_; }

  private:
    // [spacings]
    static constexpr double kSkin = D == 2 ? 1.5 : 1.2, kInnerSkin = 0.3;

    solver::ClusterOrder order_;
    solver::PairNeighboursOf<float> neighbours_;
    solver::HWY_NAMESPACE::PackedFields<float> fields_;
    solver::BlockColours colours_;  // half lists
    solver::HWY_NAMESPACE::HalfSums<D, float> half_sums_;
    bool has_lists_{false};
    long sorts_{};
};

// ---- candidates of a cell, side by side -----------------------------------------------------------------------------

// v and delta of all particles, as loops without packed fields read them.
template <int D>
using NarrowFields = std::array<std::vector<float>, D + 1>;

template <int D>
void fill_narrow(const PlainPass<D>& pass, std::size_t count, NarrowFields<D>& fields) {
    for (std::vector<float>& field : fields) field.resize(count);
    solver::parallel_for(count, solver::kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        std::array<double, solver::kParticleBlock> values;
        for (std::size_t f = 0; f <= D; ++f) {
            pass.fluid_fields()[f].read(begin, end - begin, values.data());
            std::copy_n(values.data(), end - begin, fields[f].data() + begin);
        }
    });
}

// x, v, delta and V of the particles of the cells around a cell, field by field, relative to a point of the cell; out
// of reach beyond the last one.
template <int D>
class CandidateBuffer {
  public:
    static constexpr std::size_t kFields = 2 * D + 2, kV = 2 * D + 1;

    HWY_NOINLINE void fill(const PlainFluid& fluid, const NarrowFields<D>& fields, const solver::CellGrid& grid,
                           std::size_t c) {
        const solver::Neighbourhood near = grid.around(c);
        constexpr std::size_t N = kPairLanes<float>;
        count_ = near.particles;
        stride_ = (count_ + N - 1) / N * N;
        if (numbers_.size() < kFields * stride_) numbers_.resize(kFields * stride_);
        for (int k = 0; k < D; ++k) origin_[k] = fluid.x[k][grid.cell(c).begin];
        std::size_t at = 0;
        for (int r = 0; r < near.runs; ++r) {
            const solver::Run& run = near.run[r];
            for (int k = 0; k < D; ++k) {
                const double shift = run.image[k] * (fluid.domain.max[k] - fluid.domain.min[k]) - origin_[k];
                copy(fluid.x[k].data(), run, shift, field(k) + at);
            }
            for (std::size_t f = 0; f <= D; ++f) copy(fields[f].data(), run, field(D + f) + at);
            copy(fluid.V.data(), run, field(kV) + at);
            at += run.end - run.begin;
        }
        for (std::size_t f = 0; f < kFields; ++f) {
            const double nowhere = f < D ? 100.0 * fluid.support : 0.0;
            std::fill(field(f) + count_, field(f) + stride_, static_cast<float>(nowhere));
        }
    }

    float* field(std::size_t f) { return numbers_.data() + f * stride_; }
    const float* field(std::size_t f) const { return numbers_.data() + f * stride_; }
    std::size_t size() const { return count_; }
    double origin(int k) const { return origin_[k]; }

  private:
    static void copy(const double* from, const solver::Run& run, double shift, float* to) {
        for (Index j = run.begin; j < run.end; ++j) *to++ = static_cast<float>(from[j] + shift);
    }
    static void copy(const float* from, const solver::Run& run, float* to) {
        std::copy(from + run.begin, from + run.end, to);
    }

    std::size_t count_{}, stride_{};
    std::array<double, D> origin_{};
    solver::AlignedArray<float> numbers_;
};

template <int D, class T>
HWY_INLINE void set_distance(solver::Pair<D, T>& pair) {
    pair.r2 = solver::squared_distance<D, T>(pair.x_ij);
    pair.r = solver::HWY_NAMESPACE::square_root<float>(pair.r2);
}

template <class T>
HWY_INLINE T load(const float* from) {
    T lanes;
    __builtin_memcpy(&lanes.v, from, sizeof lanes.v);
    return lanes;
}

// Vectors of candidates against one particle after the other.
template <int D>
HWY_NOINLINE void sum_cell_buffered(const PlainPass<D>& pass, const NarrowFields<D>& fields,
                                    const CandidateBuffer<D>& candidates, Index begin, Index end) {
    using T = PairLanes<float>;
    using PointSums = typename PlainPass<D>::template Sums<double>;
    constexpr std::size_t kSums = sizeof(PointSums) / sizeof(double);
    for (Index i = begin; i < end; ++i) {
        std::array<T, D> x_i;
        for (int k = 0; k < D; ++k) x_i[k] = T(pass.fluid.x[k][i] - candidates.origin(k));
        solver::FieldsOf<T, D + 1> self, neighbour;
        for (std::size_t f = 0; f <= D; ++f) self.field[f] = T(static_cast<double>(fields[f][i]));
        typename PlainPass<D>::template Sums<T> sums{};
        for (std::size_t j = 0; j < candidates.size(); j += T::kCount) {
            solver::Pair<D, T> pair;
            for (std::size_t k = 0; k < D; ++k) pair.x_ij[k] = x_i[k] - load<T>(candidates.field(k) + j);
            set_distance(pair);
            pair.V_j = load<T>(candidates.field(CandidateBuffer<D>::kV) + j);
            for (std::size_t f = 0; f <= D; ++f) neighbour.field[f] = load<T>(candidates.field(D + f) + j);
            pass.template pair<false>(self, pair, neighbour, sums);
        }
        alignas(64) float lanes[kSums][T::kCount];
        __builtin_memcpy(lanes, &sums, sizeof lanes);
        std::array<double, kSums> total{};
        for (std::size_t s = 0; s < kSums; ++s)
            for (const float lane : lanes[s]) total[s] += static_cast<double>(lane);
        PointSums point;
        __builtin_memcpy(static_cast<void*>(&point), total.data(), sizeof point);
        pass.store(i, point);
    }
}

// One candidate after the other against vectors of particles.
template <int D>
HWY_NOINLINE void sum_cell_broadcast(const PlainPass<D>& pass, const NarrowFields<D>& fields,
                                     const CandidateBuffer<D>& candidates, Index begin, Index end) {
    using T = PairLanes<float>;
    using PointSums = typename PlainPass<D>::template Sums<double>;
    constexpr std::size_t kSums = sizeof(PointSums) / sizeof(double), N = T::kCount;
    for (Index first = begin; first < end; first += N) {
        const std::size_t points = std::min<std::size_t>(N, end - first);
        alignas(64) float own[2 * D + 1][N] = {};  // those beyond the last point are not stored
        for (std::size_t l = 0; l < points; ++l) {
            for (int k = 0; k < D; ++k)
                own[k][l] = static_cast<float>(pass.fluid.x[k][first + l] - candidates.origin(k));
            for (std::size_t f = 0; f <= D; ++f) own[D + f][l] = fields[f][first + l];
        }
        std::array<T, D> x_i;
        for (int k = 0; k < D; ++k) x_i[k] = load<T>(own[k]);
        solver::FieldsOf<T, D + 1> self, neighbour;
        for (std::size_t f = 0; f <= D; ++f) self.field[f] = load<T>(own[D + f]);
        typename PlainPass<D>::template Sums<T> sums{};
        const auto number = [&](std::size_t f, std::size_t j)
                                HWY_ATTR { return T(static_cast<double>(candidates.field(f)[j])); };
        for (std::size_t j = 0; j < candidates.size(); ++j) {
            solver::Pair<D, T> pair;
            for (std::size_t k = 0; k < D; ++k) pair.x_ij[k] = x_i[k] - number(k, j);
            set_distance(pair);
            pair.V_j = number(CandidateBuffer<D>::kV, j);
            for (std::size_t f = 0; f <= D; ++f) neighbour.field[f] = number(D + f, j);
            pass.template pair<false>(self, pair, neighbour, sums);
        }
        alignas(64) float lanes[kSums][N];
        __builtin_memcpy(lanes, &sums, sizeof lanes);
        for (std::size_t l = 0; l < points; ++l) {
            std::array<double, kSums> total;
            for (std::size_t s = 0; s < kSums; ++s) total[s] = static_cast<double>(lanes[s][l]);
            PointSums point;
            __builtin_memcpy(static_cast<void*>(&point), total.data(), sizeof point);
            pass.store(first + static_cast<Index>(l), point);
        }
    }
}

template <int D, bool IsBroadcast>
class CellSums final : public PlainSums {
  public:
    void compute(PlainFluid& fluid, StageSeconds& seconds) override {
        StageClock clock;
        wrap_plain_fluid(fluid);
        grid_.build(fluid.x, fluid.id, D, fluid.support, &fluid.domain);
        permute_plain_fluid(fluid, grid_);
        ++sorts_;
        seconds.sort += clock.lap();
        const PlainPass<D> pass(fluid);
        fill_narrow<D>(pass, fluid.size(), fields_);
        buffers_.resize(static_cast<std::size_t>(solver::max_threads()));
        solver::parallel_for(grid_.cells(), 8, [&](std::size_t first, std::size_t last, int thread) {
            CandidateBuffer<D>& buffer = buffers_[static_cast<std::size_t>(thread)];
            for (std::size_t c = first; c < last; ++c) {
                const solver::Run cell = grid_.cell(c);
                buffer.fill(fluid, fields_, grid_, c);
                if constexpr (IsBroadcast) {
                    sum_cell_broadcast<D>(pass, fields_, buffer, cell.begin, cell.end);
                } else {
                    sum_cell_buffered<D>(pass, fields_, buffer, cell.begin, cell.end);
                }
            }
        });
        seconds.pair += clock.lap();
    }

    double candidates() const override {
        double pairs = 0.0, particles = 0.0;
        for (std::size_t c = 0; c < grid_.cells(); ++c) {
            const solver::Run cell = grid_.cell(c);
            pairs += static_cast<double>(cell.end - cell.begin) * static_cast<double>(grid_.around(c).particles);
            particles += cell.end - cell.begin;
        }
        return pairs / particles;
    }
    long sorts() const override { return sorts_; }

  private:
    solver::CellGrid grid_;
    NarrowFields<D> fields_;
    std::vector<CandidateBuffer<D>> buffers_;  // one per thread
    long sorts_{};
};

template <int D>
PlainSums* make_sums_in(PairStrategy strategy) {
    if (strategy == PairStrategy::clusters) return new ClusterSums<D, false>();
    if (strategy == PairStrategy::half) return new ClusterSums<D, true>();
    if (strategy == PairStrategy::buffer) return new CellSums<D, false>();
    return new CellSums<D, true>();
}

PlainSums* make_sums(PairStrategy strategy, int dimensions) {
    return dimensions == 2 ? make_sums_in<2>(strategy) : make_sums_in<3>(strategy);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace headrace::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
