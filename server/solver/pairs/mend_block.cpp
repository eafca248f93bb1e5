#include "server/solver/pairs/mend_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace headrace::solver {
namespace {

// Boxes around the places of now of a block's clusters, relative to a reference point.
template <class S>
BlockBoxes boxes_of_now(const ClusterPoints<S>& points, std::size_t block, const std::array<std::int32_t, 3>& base) {
    BlockBoxes boxes;
    boxes.clear();
    const std::size_t first = block * kBlockClusters, last = std::min(first + kBlockClusters, points.clusters());
    for (std::size_t c = first; c < last; ++c) {
        const S* record = points.record(c);
        const std::size_t count = std::min(kClusterSize, points.size() - c * kClusterSize);
        for (int k = 0; k < points.dimensions(); ++k, record += kClusterSize) {
            const auto [low, high] = std::minmax_element(record, record + count);
            const double shift = (points.reference(c)[k] - base[k]) * points.reference_step();
            boxes.set(k, c - first, static_cast<double>(*low) + shift, static_cast<double>(*high) + shift);
        }
    }
    return boxes;
}

// Bit c: is cluster c of `boxes` within reach of cluster n of `others`? Boxes: none that is is lost.
std::uint16_t boxes_near(const BlockBoxes& boxes, const BlockBoxes& others, std::size_t n, int dimensions,
                         double reach) {
    std::array<float, kBlockClusters> gap2{};
    for (int k = 0; k < dimensions; ++k) {
        const float low = others.low[k][n], high = others.high[k][n];
        for (std::size_t c = 0; c < kBlockClusters; ++c) {
            const float gap = std::max({0.0f, boxes.low[k][c] - high, low - boxes.high[k][c]});
            gap2[c] += gap * gap;
        }
    }
    constexpr double kRoundedUp = 1.0 + 1e-4;
    const auto reach2 = static_cast<float>(reach * reach * kRoundedUp);
    unsigned near = 0;
    for (std::size_t c = 0; c < kBlockClusters; ++c) near |= unsigned{gap2[c] < reach2} << c;
    return static_cast<std::uint16_t>(near);
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
    std::vector<std::array<std::uint16_t, kBlockClusters>> listed(neighbour_blocks.size());
    block.for_each_listed([&](std::size_t c, Index cluster, Index) {
        const auto at = std::find(neighbour_blocks.begin(), neighbour_blocks.end(), cluster / kBlockClusters);
        if (at == neighbour_blocks.end()) return;
        std::uint16_t& by = listed[static_cast<std::size_t>(at - neighbour_blocks.begin())][cluster % kBlockClusters];
        by = static_cast<std::uint16_t>(by | 1u << c);
    });
    const auto& base = centres.reference(b * kBlockClusters);
    const BlockBoxes own = boxes_of_now(centres, b, base);
    const std::size_t own_clusters = std::min(kBlockClusters, centres.clusters() - b * kBlockClusters);
    std::vector<LackedPair> lacked;
    for (std::size_t o = 0; o < neighbour_blocks.size(); ++o) {
        const BlockBoxes others = boxes_of_now(neighbours, neighbour_blocks[o], base);
        const std::size_t first = neighbour_blocks[o] * kBlockClusters;
        for (std::size_t n = 0; n < std::min(kBlockClusters, neighbours.clusters() - first); ++n) {
            const unsigned unlisted = boxes_near(own, others, n, centres.dimensions(), reach) & ~unsigned{listed[o][n]};
            if (unlisted == 0) continue;
            const std::size_t cluster = first + n;
            for (std::size_t c = 0; c < own_clusters; ++c) {
                if ((unlisted >> c & 1u) != 0 &&
                    is_pair_near(centres, b * kBlockClusters + c, neighbours, cluster, reach))
                    lacked.push_back({c, static_cast<Index>(cluster)});
            }
        }
    }
    std::stable_sort(lacked.begin(), lacked.end(),
                     [](const LackedPair& p, const LackedPair& q) { return p.centre < q.centre; });
    return lacked;
}

}  // namespace

template <class S>
bool mend_block(PairBlock<S>& block, std::size_t b, const ClusterPoints<S>& centres, const ClusterPoints<S>& neighbours,
                const std::vector<Index>& neighbour_blocks, double reach) {
    const auto lacked = find_lacked(block, b, centres, neighbours, neighbour_blocks, reach);
    if (lacked.empty()) return true;
    std::vector<PairEntry> entries;
    auto next = lacked.begin();
    std::size_t hint = 0;
    for (std::size_t c = 0; c < kBlockClusters; ++c) {
        PairRow& row = block.rows[c];
        const auto at = [&](Index entry) { return block.entries.begin() + entry; };
        const auto begin = static_cast<Index>(entries.size());
        entries.insert(entries.end(), at(row.begin), at(row.end));
        const auto pruned = std::vector<PairEntry>(at(row.end), at(block.listed_end(c)));
        for (; next != lacked.end() && next->centre == c; ++next) {
            const Index place = next->neighbour % kBlockClusters;
            PairWay<S> way{{}, next->neighbour - place};
            const auto &from = centres.reference(b * kBlockClusters + c), &to = neighbours.reference(next->neighbour);
            for (int k = 0; k < centres.dimensions(); ++k)
                way.offset[k] = static_cast<S>((from[k] - to[k]) * centres.reference_step());
            const Index number = number_of_way(block.ways, row.ways, way, hint);
            if (number >= kMostWays) return false;
            entries.push_back(make_entry(number, place));
        }
        row.begin = begin;
        row.end = static_cast<Index>(entries.size());
        entries.insert(entries.end(), pruned.begin(), pruned.end());
    }
    block.rows[kBlockClusters].begin = block.rows[kBlockClusters].end = static_cast<Index>(entries.size());
    block.entries = std::move(entries);
    return true;
}

template bool mend_block(PairBlock<float>&, std::size_t, const ClusterPoints<float>&, const ClusterPoints<float>&,
                         const std::vector<Index>&, double);
template bool mend_block(PairBlock<double>&, std::size_t, const ClusterPoints<double>&, const ClusterPoints<double>&,
                         const std::vector<Index>&, double);

}  // namespace headrace::solver
