#include "server/solver/pairs/nearby_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace headrace::solver {
namespace {

// Extents up to this many reaches are looked at as one box.
constexpr double kWidest = 8.0;

// What rounding to float may have taken from a box of this half width at this place, and somewhat more: the clusters of
// spray are as wide as the scene.
float rounding_of(float centre, float half, float shift) {
    constexpr float kEpsilon = std::numeric_limits<float>::epsilon();
    return 4.0f * kEpsilon * (std::abs(centre) + half + std::abs(shift));
}

void drop_repeated(std::vector<Candidate>& candidates) {
    const auto key = [](const Candidate& c) { return std::pair(c.offset, c.cluster); };
    std::sort(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    const auto is_same = [&](const auto& a, const auto& b) { return key(a) == key(b); };
    candidates.erase(std::unique(candidates.begin(), candidates.end(), is_same), candidates.end());
}

Extent join(const Extent& a, const Extent& b) {
    Extent both;
    for (int k = 0; k < 3; ++k) {
        both.low[k] = std::min(a.low[k], b.low[k]);
        both.high[k] = std::max(a.high[k], b.high[k]);
    }
    return both;
}

}  // namespace

Extent extent_of(const VectorField& x, int dimensions, std::size_t begin, std::size_t end) {
    Extent extent;
    for (int k = 0; k < dimensions; ++k) {
        extent.low[k] = extent.high[k] = x[k][begin];
        for (std::size_t i = begin + 1; i < end; ++i) {
            extent.low[k] = std::min(extent.low[k], x[k][i]);
            extent.high[k] = std::max(extent.high[k], x[k][i]);
        }
    }
    return extent;
}

bool is_wide(const Extent& extent, int dimensions, double reach) {
    for (int k = 0; k < dimensions; ++k) {
        if (!(extent.high[k] - extent.low[k] < kWidest * reach)) return true;
    }
    return false;
}

template <class S>
void NearbyClusters<S>::start(const Setting& setting) {
    setting_ = setting;
    stamp_.assign(setting.neighbours->clusters(), 0);
    look_ = 0;
}

template <class S>
std::size_t NearbyClusters<S>::find(std::size_t first, std::size_t last) {
    Extent extent;
    const std::size_t end = end_of_group(first, last, extent);
    base_ = setting_.centres->reference(first);
    has_offsets_ = false;
    collect(first, end, extent);
    sort_by_way();
    place_boxes(first);
    return end;
}

// A cluster that is wide itself is a group of its own.
template <class S>
std::size_t NearbyClusters<S>::end_of_group(std::size_t first, std::size_t last, Extent& extent) const {
    const ClusterPoints<S>& centres = *setting_.centres;
    std::size_t end = first;
    for (; end < last; ++end) {
        const std::size_t begin = end * kClusterSize;
        const Extent own =
            extent_of(*setting_.x, centres.dimensions(), begin, std::min(begin + kClusterSize, centres.size()));
        const Extent both = end == first ? own : join(extent, own);
        if (end > first && is_wide(both, centres.dimensions(), setting_.reach)) break;
        extent = both;
    }
    return end;
}

template <class S>
void NearbyClusters<S>::collect(std::size_t first, std::size_t end, const Extent& extent) {
    const ClusterPoints<S>& centres = *setting_.centres;
    const std::size_t begin = first * kClusterSize, end_point = std::min(end * kClusterSize, centres.size());
    found_.clear();
    ways_.clear();
    way_ = 0;
    std::array<int, 3> image{};
    ++look_;
    for_each_run_near(*setting_.order, *setting_.x, centres.dimensions(), begin, end_point, extent, setting_.reach,
                      [&](const SlotRun& run) {
                          if (run.image != image) {
                              ++look_;
                              image = run.image;
                          }
                          const Index last = (run.end - 1) / kClusterSize;
                          for (Index j = run.begin / kClusterSize; j <= last; ++j) {
                              if (stamp_[j] == look_) continue;
                              stamp_[j] = look_;
                              found_.push_back({j, way_to(j, image)});
                          }
                      });
    if (is_wide(extent, centres.dimensions(), setting_.reach)) drop_repeated(found_);
}

template <class S>
Index NearbyClusters<S>::way_to(std::size_t cluster, const std::array<int, 3>& image) {
    const std::uint64_t key = setting_.neighbours->reference_key(cluster);
    const auto leads_there = [&](Index w) {
        return w < ways_.size() && ways_[w].key == key && ways_[w].image == image;
    };
    if (leads_there(way_)) return way_;
    for (way_ = 0; way_ < ways_.size(); ++way_) {
        if (leads_there(way_)) return way_;
    }
    ways_.push_back({key, setting_.neighbours->reference(cluster), image});
    return way_;
}

template <class S>
void NearbyClusters<S>::sort_by_way() {
    counts_.assign(ways_.size() + 1, 0);
    for (const Candidate& candidate : found_) ++counts_[candidate.offset + 1];
    for (std::size_t w = 1; w < counts_.size(); ++w) counts_[w] += counts_[w - 1];
    sorted_.resize(found_.size());
    for (const Candidate& candidate : found_) sorted_[counts_[candidate.offset]++] = candidate;
}

template <class S>
void NearbyClusters<S>::place_boxes(std::size_t base) {
    const std::size_t count = sorted_.size();
    const auto& reference = setting_.centres->reference(base);
    for (int k = 0; k < setting_.centres->dimensions(); ++k) {
        centre_[k].resize(count + BoxQuery::kPadding);
        half_[k].resize(count + BoxQuery::kPadding);
        std::size_t begin = 0;
        for (std::size_t w = 0; w < ways_.size(); begin = counts_[w++]) {
            const auto shift = static_cast<float>(-offset_to(ways_[w], reference, k));
            for (std::size_t c = begin; c < counts_[w]; ++c) {
                const ClusterBox& box = setting_.neighbours->box(sorted_[c].cluster);
                centre_[k][c] = box.centre[k] + shift;
                half_[k][c] = box.half[k] + rounding_of(box.centre[k], box.half[k], shift);
            }
        }
        std::fill_n(&centre_[k][count], BoxQuery::kPadding, std::numeric_limits<float>::max());
        std::fill_n(&half_[k][count], BoxQuery::kPadding, 0.0f);
    }
    kept_.resize(count + BoxQuery::kPadding);
}

template <class S>
const std::vector<Candidate>& NearbyClusters<S>::near(std::size_t centre) {
    const ClusterPoints<S>& centres = *setting_.centres;
    const int dimensions = centres.dimensions();
    const auto& reference = centres.reference(centre);
    BoxQuery boxes{dimensions, {}, {}, sorted_.size(), centres.box(centre), setting_.reach};
    for (int k = 0; k < dimensions; ++k) {
        boxes.centre[k] = centre_[k].data();
        boxes.half[k] = half_[k].data();
        const auto shift = static_cast<float>((reference[k] - base_[k]) * centres.reference_step());
        boxes.box.half[k] += rounding_of(boxes.box.centre[k], boxes.box.half[k], shift);
        boxes.box.centre[k] += shift;
    }
    const std::size_t within = filter_boxes(boxes, kept_.data());
    near_.resize(within);
    for (std::size_t k = 0; k < within; ++k) near_[k] = sorted_[kept_[k]];
    if (!std::exchange(has_offsets_, true) || reference != offsets_of_) {
        offsets_of_ = reference;
        offsets_.resize(ways_.size());
        for (std::size_t w = 0; w < ways_.size(); ++w) {
            for (int k = 0; k < dimensions; ++k) offsets_[w][k] = static_cast<S>(offset_to(ways_[w], reference, k));
        }
    }
    const std::size_t begin = centre * kClusterSize, points = std::min(kClusterSize, centres.size() - begin);
    near_.resize(filter_reach(
        {dimensions, centres.record(centre), points, setting_.neighbours->record(0), offsets_.data(), setting_.reach},
        near_.data(), within));
    return near_;
}

template class NearbyClusters<float>;
template class NearbyClusters<double>;

}  // namespace headrace::solver
