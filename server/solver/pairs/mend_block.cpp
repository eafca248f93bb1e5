#include "server/solver/pairs/mend_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace headrace::solver {
namespace {

// Boxes around the places of now of a block's clusters [m], side by side, relative to a reference point: longer by what
// rounding may have taken, since the clusters of spray are far apart.
struct BlockBoxes {
    std::array<std::array<float, kMotionBlock>, 3> low{}, high{};
    std::size_t clusters{};
};

template <class S>
BlockBoxes boxes_of_block(const ClusterPoints<S>& points, std::size_t block, const std::array<std::int32_t, 3>& base) {
    constexpr double kEpsilon = std::numeric_limits<float>::epsilon();
    BlockBoxes boxes;
    const std::size_t first = block * kMotionBlock;
    boxes.clusters = std::min(kMotionBlock, points.clusters() - first);
    for (std::size_t c = 0; c < boxes.clusters; ++c) {
        const S* record = points.record(first + c);
        const std::size_t count = std::min(kClusterSize, points.size() - (first + c) * kClusterSize);
        for (int k = 0; k < points.dimensions(); ++k, record += kClusterSize) {
            const auto [low, high] = std::minmax_element(record, record + count);
            const double shift = (points.reference(first + c)[k] - base[k]) * points.reference_step();
            const double from = static_cast<double>(*low) + shift, to = static_cast<double>(*high) + shift;
            const double rounding = kEpsilon * (std::abs(from) + std::abs(to));
            boxes.low[k][c] = static_cast<float>(from - rounding);
            boxes.high[k][c] = static_cast<float>(to + rounding);
        }
    }
    return boxes;
}

// Bit c: is cluster c of `boxes` within reach of cluster n of `others`? Boxes: none that is is lost.
std::uint16_t boxes_near(const BlockBoxes& boxes, const BlockBoxes& others, std::size_t n, double reach) {
    std::array<float, kMotionBlock> gap2{};
    for (int k = 0; k < 3; ++k) {
        const float low = others.low[k][n], high = others.high[k][n];
        for (std::size_t c = 0; c < kMotionBlock; ++c) {
            const float gap = std::max({0.0f, boxes.low[k][c] - high, low - boxes.high[k][c]});
            gap2[c] += gap * gap;
        }
    }
    constexpr double kRoundedUp = 1.0 + 1e-4;
    const auto reach2 = static_cast<float>(reach * reach * kRoundedUp);
    std::uint16_t near = 0;
    for (std::size_t c = 0; c < boxes.clusters; ++c) near = static_cast<std::uint16_t>(near | (gap2[c] < reach2) << c);
    return near;
}

// Is any point of one cluster within reach of one of the other's?
template <class S>
bool is_pair_near(const ClusterPoints<S>& centres, std::size_t c, const ClusterPoints<S>& neighbours, std::size_t n,
                  double reach) {
    const auto points_of = [](const ClusterPoints<S>& points, std::size_t cluster) {
        return std::min(kClusterSize, points.size() - cluster * kClusterSize);
    };
    const S *from = centres.record(c), *to = neighbours.record(n);
    for (std::size_t i = 0; i < points_of(centres, c); ++i) {
        for (std::size_t j = 0; j < points_of(neighbours, n); ++j) {
            double r2 = 0.0;
            for (int k = 0; k < centres.dimensions(); ++k) {
                const std::size_t axis = static_cast<std::size_t>(k) * kClusterSize;
                const double apart = static_cast<double>(from[axis + i]) - static_cast<double>(to[axis + j]) +
                                     (centres.reference(c)[k] - neighbours.reference(n)[k]) * centres.reference_step();
                r2 += apart * apart;
            }
            if (r2 < reach * reach) return true;
        }
    }
    return false;
}

struct LackedPair {
    std::size_t centre{};  // within the block
    Index neighbour{};     // cluster
};

// By centre.
template <class S>
std::vector<LackedPair> find_lacked(const PairBlock<S>& block, std::size_t b, const ClusterPoints<S>& centres,
                                    const ClusterPoints<S>& neighbours, const std::vector<Index>& neighbour_blocks,
                                    double reach) {
    // Of each neighbour, bit c: is it on the list of centre c?
    std::vector<std::array<std::uint16_t, kMotionBlock>> listed(neighbour_blocks.size());
    block.for_each_listed([&](std::size_t c, Index cluster, Index) {
        const auto at = std::find(neighbour_blocks.begin(), neighbour_blocks.end(), cluster / kMotionBlock);
        if (at == neighbour_blocks.end()) return;
        std::uint16_t& by = listed[static_cast<std::size_t>(at - neighbour_blocks.begin())][cluster % kMotionBlock];
        by = static_cast<std::uint16_t>(by | 1u << c);
    });
    const auto& base = centres.reference(b * kMotionBlock);
    const BlockBoxes own = boxes_of_block(centres, b, base);
    std::vector<LackedPair> lacked;
    for (std::size_t o = 0; o < neighbour_blocks.size(); ++o) {
        const BlockBoxes others = boxes_of_block(neighbours, neighbour_blocks[o], base);
        for (std::size_t n = 0; n < others.clusters; ++n) {
            const unsigned unlisted = boxes_near(own, others, n, reach) & ~unsigned{listed[o][n]};
            if (unlisted == 0) continue;
            const std::size_t cluster = neighbour_blocks[o] * kMotionBlock + n;
            for (std::size_t c = 0; c < own.clusters; ++c) {
                if ((unlisted >> c & 1u) != 0 &&
                    is_pair_near(centres, b * kMotionBlock + c, neighbours, cluster, reach))
                    lacked.push_back({c, static_cast<Index>(cluster)});
            }
        }
    }
    std::stable_sort(lacked.begin(), lacked.end(),
                     [](const LackedPair& p, const LackedPair& q) { return p.centre < q.centre; });
    return lacked;
}

template <class S>
Index number_of_way(std::vector<PairWay<S>>& ways, const PairWay<S>& way) {
    const auto at = std::find(ways.begin(), ways.end(), way);
    if (at != ways.end()) return static_cast<Index>(at - ways.begin());
    ways.push_back(way);
    return static_cast<Index>(ways.size() - 1);
}

}  // namespace

template <class S>
void mend_block(PairBlock<S>& block, std::size_t b, const ClusterPoints<S>& centres, const ClusterPoints<S>& neighbours,
                const std::vector<Index>& neighbour_blocks, double reach) {
    const auto lacked = find_lacked(block, b, centres, neighbours, neighbour_blocks, reach);
    if (lacked.empty()) return;
    std::vector<PairGroup> groups;
    std::vector<PairEntry> entries;
    auto next = lacked.begin();
    for (std::size_t c = 0; c < kMotionBlock; ++c) {
        const Index first = block.first_group[c], last = block.first_group[c + 1];
        const Index from = block.groups[first].begin, to = block.groups[last].begin;
        const auto shift = static_cast<Index>(entries.size()) - from;
        block.first_group[c] = static_cast<Index>(groups.size());
        for (Index g = first; g < last; ++g) {
            const PairGroup& group = block.groups[g];
            groups.push_back({group.begin + shift, group.end + shift, group.way});
        }
        entries.insert(entries.end(), block.entries.begin() + from, block.entries.begin() + to);
        for (; next != lacked.end() && next->centre == c; ++next) {
            PairWay<S> way{page_of(next->neighbour), {}};
            const auto &at = centres.reference(b * kMotionBlock + c), &of = neighbours.reference(next->neighbour);
            for (int k = 0; k < centres.dimensions(); ++k)
                way.offset[k] = static_cast<S>((at[k] - of[k]) * centres.reference_step());
            const auto entry = static_cast<Index>(entries.size());
            groups.push_back({entry, entry + 1, number_of_way(block.ways, way)});
            entries.push_back(static_cast<PairEntry>(next->neighbour));
        }
    }
    block.first_group[kMotionBlock] = static_cast<Index>(groups.size());
    const auto end = static_cast<Index>(entries.size());
    groups.push_back({end, end, 0});
    block.groups = std::move(groups);
    block.entries = std::move(entries);
}

template void mend_block(PairBlock<float>&, std::size_t, const ClusterPoints<float>&, const ClusterPoints<float>&,
                         const std::vector<Index>&, double);
template void mend_block(PairBlock<double>&, std::size_t, const ClusterPoints<double>&, const ClusterPoints<double>&,
                         const std::vector<Index>&, double);

}  // namespace headrace::solver
