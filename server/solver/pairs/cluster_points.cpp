#include "server/solver/pairs/cluster_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/solver/lanes.h"
#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

// Where places beyond the last point stand [reference steps]: out of reach of any cluster's neighbours, and the square
// is far from overflow.
constexpr double kOutOfReach = 1000.0;

// Points further than so many support radii from their block's reference point have one of their own.
constexpr double kFarthest = 2.0;

std::int32_t cube_of(double x, double step) {
    constexpr double kOutermost = 1e9;  // a faulted state may be packed without harm
    const double cube = std::floor(x / step);
    return cube > -kOutermost ? static_cast<std::int32_t>(std::min(cube, kOutermost))
                              : static_cast<std::int32_t>(-kOutermost);
}

double centre_of(std::int32_t cube, double step) {
    return (cube + 0.5) * step;
}

// The sum of two displacements, moved outwards by what rounding may take.
float add_outwards(float a, float b, float sign) {
    const float sum = a + b;
    return sum + sign * std::numeric_limits<float>::epsilon() * std::abs(sum);
}

struct Range {
    double low{}, high{};

    double middle() const { return 0.5 * (low + high); }
};

Range range_of(const std::vector<double>& x, std::size_t begin, std::size_t end) {
    Range range{x[begin], x[begin]};
    for (std::size_t i = begin + 1; i < end; ++i) {
        range.low = std::min(range.low, x[i]);
        range.high = std::max(range.high, x[i]);
    }
    return range;
}

}  // namespace

template <class S>
void ClusterPoints<S>::start(const VectorField& x, const FieldView& V, std::size_t count, int dimensions,
                             double support, bool moves) {
    count_ = count;
    dimensions_ = dimensions;
    step_ = std::exp2(std::ceil(std::log2(0.25 * support)));
    stride_ = static_cast<std::size_t>(dimensions + 1) * kClusterSize;
    records_.resize(clusters() * stride_);
    moves_ = moves;
    motion_.assign((clusters() + kBlockClusters - 1) / kBlockClusters, MotionBox{});
    total_ = motion_;
    boxes_.resize(motion_.size());
    other_reference_.resize(motion_.size());
    choose_references(x, support);
    pack<true>(x, V);
}

template <class S>
void ClusterPoints<S>::choose_references(const VectorField& x, double support) {
    std::vector<std::array<std::int32_t, 3>> of_clusters(clusters());
    parallel_for(clusters(), kBlockClusters, [&](std::size_t first, std::size_t last, int) {
        std::array<std::int32_t, 3> reference{};
        for (int k = 0; k < dimensions_; ++k) {
            const Range block = range_of(x[k], first * kClusterSize, std::min(last * kClusterSize, count_));
            reference[k] = cube_of(block.middle(), step_);
        }
        unsigned others = 0;
        for (std::size_t c = first; c < last; ++c) {
            std::array<Range, 3> of_cluster{};
            bool is_near = true;
            for (int k = 0; k < dimensions_; ++k) {
                of_cluster[k] = range_of(x[k], c * kClusterSize, std::min((c + 1) * kClusterSize, count_));
                const double centre = centre_of(reference[k], step_);
                is_near &= std::max(of_cluster[k].high - centre, centre - of_cluster[k].low) < kFarthest * support;
            }
            for (int k = 0; k < dimensions_ && !is_near; ++k) reference[k] = cube_of(of_cluster[k].middle(), step_);
            of_clusters[c] = reference;
            if (!is_near) others |= 1u << (c - first);
        }
        other_reference_[first / kBlockClusters] = static_cast<std::uint16_t>(others);
    });
    references_.clear();
    first_reference_.resize(other_reference_.size());
    for (std::size_t b = 0; b < first_reference_.size(); ++b) {
        first_reference_[b] = static_cast<Index>(references_.size());
        for (unsigned chosen = other_reference_[b] | 1u; chosen != 0; chosen &= chosen - 1)
            references_.push_back(of_clusters[b * kBlockClusters + static_cast<std::size_t>(std::countr_zero(chosen))]);
    }
}

template <class S>
void ClusterPoints<S>::update(const VectorField& x, const FieldView& V) {
    pack<false>(x, V);
}

template <class S>
void ClusterPoints<S>::settle() {
    motion_.assign(motion_.size(), MotionBox{});
}

template <class S>
template <bool IsStart>
void ClusterPoints<S>::pack(const VectorField& x, const FieldView& V) {
    parallel_for(clusters(), kBlockClusters, [&](std::size_t first, std::size_t last, int) {
        const std::size_t block = first / kBlockClusters;
        if constexpr (IsStart) boxes_[block].clear();
        for (int k = 0; k < dimensions_; ++k) pack_axis<IsStart>(x[k], k, first, last);
        std::array<double, kBlockClusters * kClusterSize> volumes{};
        V.read(first * kClusterSize, std::min(last * kClusterSize, count_) - first * kClusterSize, volumes.data());
        for (std::size_t c = first; c < last; ++c) {
            S* const record = &records_[c * stride_ + static_cast<std::size_t>(dimensions_) * kClusterSize];
            for (std::size_t l = 0; l < kClusterSize; ++l)
                record[l] = static_cast<S>(volumes[(c - first) * kClusterSize + l]);
        }
    });
}

// One coordinate of the clusters [first, last) of a block.
template <class S>
template <bool IsStart>
void ClusterPoints<S>::pack_axis(const std::vector<double>& x, int axis, std::size_t first, std::size_t last) {
    using FourFloats = Lanes<float, kClusterSize>::Vector;
    const auto k = static_cast<std::size_t>(axis);
    const std::size_t block = first / kBlockClusters;
    // Of the displacements of the first points of clusters, the second ones, ...
    [[maybe_unused]] FourFloats low, high;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    low = FourFloats{} + kInfinity;
    high = -low;
    const std::array<std::int32_t, 3>* reference = &references_[first_reference_[block]];
    unsigned others = other_reference_[block] & ~1u;
    for (std::size_t c = first; c < last; ++c, others >>= 1) {
        const std::size_t begin = c * kClusterSize, in_cluster = std::min(kClusterSize, count_ - begin);
        reference += others & 1u;
        const double centre = centre_of((*reference)[k], step_);
        const double* places = x.data() + begin;
        std::array<double, kClusterSize> padded;
        if (in_cluster < kClusterSize) {
            padded.fill(centre + kOutOfReach * step_);
            std::copy_n(places, in_cluster, padded.begin());
            places = padded.data();
        }
        S* const record = &records_[c * stride_ + k * kClusterSize];
        std::array<S, kClusterSize> now;
        for (std::size_t l = 0; l < kClusterSize; ++l) now[l] = static_cast<S>(places[l] - centre);
        if constexpr (IsStart) {
            const Range range = range_of(x, begin, begin + in_cluster);
            boxes_[block].set(axis, c - first, range.low - centre, range.high - centre);
        } else {
            FourFloats moved;
            for (std::size_t l = 0; l < kClusterSize; ++l) moved[l] = static_cast<float>(now[l] - record[l]);
            low = moved < low ? moved : low;
            high = moved > high ? moved : high;
        }
        std::copy_n(now.data(), kClusterSize, record);
    }
    if constexpr (!IsStart) {
        const float from = std::min(std::min(low[0], low[1]), std::min(low[2], low[3])),
                    to = std::max(std::max(high[0], high[1]), std::max(high[2], high[3]));
        for (MotionBox* box : {&motion_[block], &total_[block]}) {
            box->low[k] = add_outwards(box->low[k], from, -1.0f);
            box->high[k] = add_outwards(box->high[k], to, 1.0f);
        }
    }
}

template class ClusterPoints<float>;
template class ClusterPoints<double>;

}  // namespace headrace::solver
