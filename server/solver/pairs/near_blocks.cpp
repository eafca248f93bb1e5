#include "server/solver/pairs/near_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace headrace::solver {
namespace {

// Extents up to this many reaches are looked at as one box.
constexpr double kWidest = 8.0;

// Are the points far apart: spray, or the ends of rows of a ragged body?
bool is_wide(const Extent& extent, int dimensions, double reach) {
    for (int k = 0; k < dimensions; ++k) {
        if (!(extent.high[k] - extent.low[k] < kWidest * reach)) return true;
    }
    return false;
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

template <class S>
void NearBlocks<S>::start(const Setting& setting) {
    setting_ = setting;
    stamp_.assign((setting.neighbours->clusters() + kBlockClusters - 1) / kBlockClusters, 0);
    stamp_of_image_ = stamp_;
    look_ = look_of_image_ = 0;
}

template <class S>
void NearBlocks<S>::find(std::size_t begin, std::size_t end) {
    const VectorField& x = *setting_.x;
    const int dimensions = setting_.centres->dimensions();
    blocks_.clear();
    found_.clear();
    const std::size_t own = begin / (kBlockClusters * kClusterSize);
    std::array<int, 3> image{};
    ++look_;
    ++look_of_image_;
    const auto visit = [&](Index block, const std::array<int, 3>& displaced) {
        if (setting_.is_half && block < own) return;
        if (std::exchange(image, displaced) != displaced) ++look_of_image_;
        if (std::exchange(stamp_of_image_[block], look_of_image_) == look_of_image_) return;
        if (std::exchange(stamp_[block], look_) != look_) blocks_.push_back(block);
        found_.push_back({block, image});
    };
    const Extent extent = extent_of(x, dimensions, begin, end);
    if (!is_wide(extent, dimensions, setting_.far_reach)) {
        setting_.grid->for_each_near(extent.low, extent.high, setting_.far_reach, visit);
        return;
    }
    for (std::size_t i = begin; i < end; ++i) {
        const Extent point = extent_of(x, dimensions, i, i + 1);
        setting_.grid->for_each_near(point.low, point.high, setting_.far_reach, visit);
    }
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
}

// Of a block with itself, displaced this way or the other, one is enough.
template <class S>
bool NearBlocks<S>::is_other_half(const Found& found, std::size_t block) const {
    return setting_.is_half && found.block == block && found.image < std::array<int, 3>{};
}

template <class S>
ClusterBox NearBlocks<S>::box_of(std::size_t cluster) const {
    const BlockBoxes& boxes = setting_.centres->boxes(cluster / kBlockClusters);
    ClusterBox box;
    for (int k = 0; k < setting_.centres->dimensions(); ++k) {
        box.low[k] = boxes.low[k][cluster % kBlockClusters];
        box.high[k] = boxes.high[k][cluster % kBlockClusters];
    }
    return box;
}

template <class S>
void NearBlocks<S>::add_ways(std::size_t first, std::size_t end, std::vector<PairWay<S>>& ways) {
    const ClusterPoints<S>& neighbours = *setting_.neighbours;
    const std::size_t before = ways.size();
    ClusterBox box = box_of(first);
    for (std::size_t c = first + 1; c < end; ++c) {
        const ClusterBox other = box_of(c);
        for (int k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], other.low[k]);
            box.high[k] = std::max(box.high[k], other.high[k]);
        }
    }
    sights_.clear();
    parts_used_ = 0;
    const std::size_t block = first / kBlockClusters;
    const Found own{static_cast<Index>(block), {}};
    if (setting_.is_half) add_way(first, own, first, end, box, ways);
    for (const Found& found : found_) {
        if (is_other_half(found, block)) continue;
        const bool is_own = setting_.is_half && found == own;
        const std::size_t block_end = std::min((found.block + 1) * kBlockClusters, neighbours.clusters());
        for (std::size_t c = found.block * kBlockClusters; c < block_end;) {
            const std::size_t to = neighbours.end_of_reference(c);
            if (!is_own || c >= end) add_way(first, found, c, to, box, ways);
            c = to;
        }
    }
    kept_.resize(sights_.size() + 1);  // the filter writes before it decides
    const std::size_t kept = filter_ways(
        {setting_.centres->dimensions(), sights_.data(), sights_.size(), box, setting_.reach}, kept_.data());
    for (std::size_t w = 0; w < kept; ++w) {
        sights_[w] = sights_[kept_[w]];
        ways[before + w] = ways[before + kept_[w]];
    }
    sights_.resize(kept);
    ways.resize(before + kept);
    if (kept > kMostWays)
        throw std::length_error("more than " + std::to_string(kMostWays) +
                                " blocks of particles within reach of one: the flow has collapsed into a point");
}

// The part [first, end) of a block.
template <class S>
void NearBlocks<S>::add_way(std::size_t centre, const Found& found, std::size_t first, std::size_t end,
                            const ClusterBox& box, std::vector<PairWay<S>>& ways) {
    const ClusterPoints<S>&centres = *setting_.centres, &neighbours = *setting_.neighbours;
    const auto &from = centres.reference(centre), &to = neighbours.reference(first);
    PairWay<S> way{{}, static_cast<Index>(found.block * kBlockClusters)};
    WaySight sight;
    for (int k = 0; k < centres.dimensions(); ++k) {
        const double offset = (from[k] - to[k]) * centres.reference_step() - found.image[k] * setting_.period[k];
        constexpr double kRounding = 2.0 * std::numeric_limits<float>::epsilon();
        const double rounding = kRounding * (std::abs(offset) + std::abs(box.low[k]) + std::abs(box.high[k]));
        way.offset[k] = static_cast<S>(offset);
        sight.up[k] = static_cast<float>(offset + rounding);
        sight.down[k] = static_cast<float>(offset - rounding);
    }
    sight.boxes = &neighbours.boxes(found.block);
    if (end - first < std::min(kBlockClusters, neighbours.clusters() - found.block * kBlockClusters)) {
        if (parts_used_ == parts_.size()) parts_.emplace_back();
        BlockBoxes& part = parts_[parts_used_++];
        part.clear();
        for (std::size_t c = first % kBlockClusters; c < end - found.block * kBlockClusters; ++c) {
            for (int k = 0; k < centres.dimensions(); ++k) {
                part.low[k][c] = sight.boxes->low[k][c];
                part.high[k][c] = sight.boxes->high[k][c];
            }
        }
        sight.boxes = &part;
    }
    ways.push_back(way);
    sights_.push_back(sight);
}

template class NearBlocks<float>;
template class NearBlocks<double>;

}  // namespace headrace::solver
