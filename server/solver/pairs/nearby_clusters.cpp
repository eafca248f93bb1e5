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

}  // namespace

Extent join(const Extent& a, const Extent& b) {
    Extent both;
    for (int k = 0; k < 3; ++k) {
        both.low[k] = std::min(a.low[k], b.low[k]);
        both.high[k] = std::max(a.high[k], b.high[k]);
    }
    return both;
}

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
std::size_t NearbyClusters<S>::find(std::size_t first, std::size_t last, const Extent* extents) {
    Extent extent;
    const std::size_t end = end_of_group(first, last, extents, extent);
    base_ = setting_.centres->reference(first);
    has_offsets_ = false;
    collect(first, end, extent);
    sort_by_way(first);
    return end;
}

// A cluster that is wide itself is a group of its own.
template <class S>
std::size_t NearbyClusters<S>::end_of_group(std::size_t first, std::size_t last, const Extent* extents,
                                            Extent& extent) const {
    extent = extents[0];
    for (std::size_t end = first + 1; end < last; ++end) {
        const Extent both = join(extent, extents[end - first]);
        if (is_wide(both, setting_.centres->dimensions(), setting_.reach)) return end;
        extent = both;
    }
    return last;
}

template <class S>
void NearbyClusters<S>::collect(std::size_t first, std::size_t end, const Extent& extent) {
    const ClusterPoints<S>& centres = *setting_.centres;
    const ClusterPoints<S>& neighbours = *setting_.neighbours;
    const std::size_t begin = first * kClusterSize, end_point = std::min(end * kClusterSize, centres.size());
    found_.clear();
    ways_.clear();
    std::array<int, 3> image{};
    std::uint64_t key = 0;
    Index page = 0, way = ~Index{0};  // of that key, page and image
    ++look_;
    for_each_run_near(*setting_.order, *setting_.x, centres.dimensions(), begin, end_point, extent, setting_.reach,
                      [&](const RowRun& run) {
                          if (run.image != image) {
                              ++look_;
                              image = run.image;
                              way = ~Index{0};
                          }
                          const Index last = (run.end - 1) / kClusterSize;
                          for (Index n = run.begin / kClusterSize; n <= last; ++n) {
                              const Index j = setting_.order->cluster_at(n);
                              if (stamp_[j] == look_) continue;
                              stamp_[j] = look_;
                              // Those of a row are in few cubes.
                              const std::uint64_t of_j = neighbours.reference_key(j);
                              if (of_j != key || page_of(j) != page || way == ~Index{0}) {
                                  key = of_j;
                                  page = page_of(j);
                                  way = way_to(j, key, image);
                              }
                              found_.push_back({j, way});
                          }
                      });
    if (is_wide(extent, centres.dimensions(), setting_.reach)) drop_repeated(found_);
}

template <class S>
void NearbyClusters<S>::drop_repeated(std::vector<Candidate>& candidates) {
    const auto key = [](const Candidate& c) { return std::pair(c.way, c.cluster); };
    std::sort(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    const auto is_same = [&](const auto& a, const auto& b) { return key(a) == key(b); };
    candidates.erase(std::unique(candidates.begin(), candidates.end(), is_same), candidates.end());
}

template <class S>
Index NearbyClusters<S>::way_to(std::size_t cluster, std::uint64_t key, const std::array<int, 3>& image) {
    const Index page = page_of(static_cast<Index>(cluster));
    for (std::size_t w = 0; w < ways_.size(); ++w) {
        if (ways_[w].key == key && ways_[w].page == page && ways_[w].image == image) return static_cast<Index>(w);
    }
    ways_.push_back({key, page, setting_.neighbours->reference(cluster), image});
    return static_cast<Index>(ways_.size() - 1);
}

// Sorts the candidates, and places the boxes around them relative to the first centre's reference point.
template <class S>
void NearbyClusters<S>::sort_by_way(std::size_t base) {
    const int dimensions = setting_.centres->dimensions();
    const std::size_t count = found_.size(), ways = ways_.size();
    at_.assign(ways + 1, 0);
    for (const Candidate& candidate : found_) ++at_[candidate.way + 1];
    for (std::size_t w = 1; w <= ways; ++w) at_[w] += at_[w - 1];
    to_way_.resize(ways);
    shift_.resize(ways);
    end_of_way_.resize(ways);
    for (std::size_t w = 0; w < ways; ++w) {
        to_way_[w].end = at_[w + 1];
        to_way_[w].way.page = ways_[w].page;
        for (int k = 0; k < dimensions; ++k)
            shift_[w][k] = static_cast<float>(-offset_to(ways_[w], setting_.centres->reference(base), k));
    }
    sorted_.resize(count);
    kept_.resize(count + BoxQuery::kPadding);
    near_.resize(count + 1);  // the filter writes before it decides
    for (int k = 0; k < dimensions; ++k) {
        centre_[k].resize(count + BoxQuery::kPadding);
        half_[k].resize(count + BoxQuery::kPadding);
        std::fill_n(&centre_[k][count], BoxQuery::kPadding, std::numeric_limits<float>::max());
        std::fill_n(&half_[k][count], BoxQuery::kPadding, 0.0f);
    }
    for (const Candidate& candidate : found_) {
        const std::size_t to = at_[candidate.way]++;
        const ClusterBox& box = setting_.neighbours->box(candidate.cluster);
        const std::array<float, 3>& shift = shift_[candidate.way];
        sorted_[to] = candidate.cluster;
        for (int k = 0; k < dimensions; ++k) {
            centre_[k][to] = box.centre[k] + shift[k];
            half_[k][to] = box.half[k] + rounding_of(box.centre[k], box.half[k], shift[k]);
        }
    }
}

template <class S>
void NearbyClusters<S>::set_offsets(const std::array<std::int32_t, 3>& reference) {
    if (std::exchange(has_offsets_, true) && reference == offsets_of_) return;
    offsets_of_ = reference;
    for (std::size_t w = 0; w < ways_.size(); ++w) {
        for (int k = 0; k < setting_.centres->dimensions(); ++k)
            to_way_[w].way.offset[k] = static_cast<S>(offset_to(ways_[w], reference, k));
    }
}

template <class S>
typename NearbyClusters<S>::Near NearbyClusters<S>::near(std::size_t centre) {
    const ClusterPoints<S>& centres = *setting_.centres;
    const int dimensions = centres.dimensions();
    const auto& reference = centres.reference(centre);
    BoxQuery boxes{dimensions, {}, {}, found_.size(), centres.box(centre), setting_.reach};
    for (int k = 0; k < dimensions; ++k) {
        boxes.centre[k] = centre_[k].data();
        boxes.half[k] = half_[k].data();
        const auto shift = static_cast<float>((reference[k] - base_[k]) * centres.reference_step());
        boxes.box.half[k] += rounding_of(boxes.box.centre[k], boxes.box.half[k], shift);
        boxes.box.centre[k] += shift;
    }
    const std::size_t within = filter_boxes(boxes, kept_.data());
    set_offsets(reference);
    const std::size_t points = std::min(kClusterSize, centres.size() - centre * kClusterSize);
    filter_reach({dimensions, centres.record(centre), points, setting_.neighbours->record(0), sorted_.data(),
                  kept_.data(), within, to_way_.data(), to_way_.size(), setting_.reach},
                 near_.data(), end_of_way_.data());
    return {near_.data(), end_of_way_.data(), to_way_.data(), to_way_.size()};
}

template class NearbyClusters<float>;
template class NearbyClusters<double>;

}  // namespace headrace::solver
