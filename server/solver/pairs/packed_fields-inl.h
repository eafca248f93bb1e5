// Fields of points as the pair loop reads them of neighbours: of each cluster, field by field, its four numbers.
// Compiled for each instruction set (Highway's foreach_target).
#include <algorithm>
#include <array>

#include "hwy/highway.h"
#include "server/solver/pairs/aligned_array.h"
#include "server/solver/pairs/cluster_order.h"
#include "server/solver/pairs/field_view.h"
#include "server/solver/parallel.h"

#if defined(HEADRACE_PAIRS_PACKED_FIELDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEADRACE_PAIRS_PACKED_FIELDS_INL_H
#undef HEADRACE_PAIRS_PACKED_FIELDS_INL_H
#else
#define HEADRACE_PAIRS_PACKED_FIELDS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace headrace::solver::HWY_NAMESPACE {

template <class S>
class PackedFields {
  public:
    // Of the fluid and of the walls, one behind the other.
    template <std::size_t FluidFields, std::size_t WallFields = 0>
    void fill(const std::array<FieldView, FluidFields>& fluid, std::size_t fluid_points,
              const std::array<FieldView, WallFields>& walls = {}, std::size_t wall_points = 0) {
        walls_at_ = numbers<FluidFields>(fluid_points);
        packed_.resize(walls_at_ + numbers<WallFields>(wall_points));
        pack_all(fluid, fluid_points, packed_.data());
        pack_all(walls, wall_points, packed_.data() + walls_at_);
    }
    const S* fluid() const { return packed_.data(); }
    const S* walls() const { return packed_.data() + walls_at_; }
    // What it held is not needed any more.
    void release() { packed_ = {}; }

  private:
    static std::size_t clusters_of(std::size_t points) { return (points + kClusterSize - 1) / kClusterSize; }
    template <std::size_t Fields>
    static std::size_t numbers(std::size_t points) {
        return clusters_of(points) * Fields * kClusterSize;
    }

    template <std::size_t Fields>
    static void pack_all(const std::array<FieldView, Fields>& fields, std::size_t points, S* to) {
        if constexpr (Fields > 0) {
            parallel_for(clusters_of(points), kAtOnce, [&](std::size_t first, std::size_t last, int) {
                for (std::size_t f = 0; f < Fields; ++f)
                    pack(fields[f], first, last, points, to + (first * Fields + f) * kClusterSize,
                         Fields * kClusterSize);
            });
        }
    }

    static constexpr std::size_t kAtOnce = 64;  // clusters: what is written of them stays in the first cache

    HWY_INLINE static void pack(const FieldView& field, std::size_t first, std::size_t last, std::size_t count, S* to,
                                std::size_t stride) {
        const double *const wide = field.wide(), *const divisor = field.divisor();
        const double factor = field.factor();
        const float* const narrow = field.narrow();
        const auto write = [&](auto&& value) {
            const std::size_t whole = std::min(last, count / kClusterSize);
            for (std::size_t c = first; c < whole; ++c, to += stride) {
                for (std::size_t l = 0; l < kClusterSize; ++l) to[l] = static_cast<S>(value(c * kClusterSize + l));
            }
            if (whole == last) return;
            for (std::size_t l = 0; l < kClusterSize; ++l) {
                const std::size_t i = whole * kClusterSize + l;
                to[l] = i < count ? static_cast<S>(value(i)) : S{};
            }
        };
        switch (field.kind()) {
            case FieldView::Kind::zero:
                return write([](std::size_t) { return 0.0; });
            case FieldView::Kind::wide:
                return write([&](std::size_t i) { return wide[i]; });
            case FieldView::Kind::narrow:
                return write([&](std::size_t i) { return narrow[i]; });
            case FieldView::Kind::product:
                return write([&](std::size_t i) { return wide[i] * static_cast<double>(narrow[i]); });
            case FieldView::Kind::quotient:
                return write([&](std::size_t i) { return wide[i] / divisor[i]; });
            case FieldView::Kind::scaled:
                return write([&](std::size_t i) { return factor * static_cast<double>(narrow[i]); });
            case FieldView::Kind::extrapolated:
                return write([&](std::size_t i) { return wide[i] + factor * static_cast<double>(narrow[i]); });
        }
    }

    AlignedArray<S> packed_;
    std::size_t walls_at_{};
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace headrace::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
