#include "server/solver/pairs/cluster_order.h"

#include <algorithm>
#include <cmath>

namespace headrace::solver {
namespace {

// Width of rows and length of bins [spacings]: of the widths tried (1.4 to 2.2) the one whose clusters see the fewest
// others; in 2D four points are a square.
constexpr double kRowWidth3d = 1.8, kRowWidth2d = 2.0, kBinLength3d = 0.4, kBinLength2d = 0.5;

// Rows side by side in a strip, which is gone through layer by layer before the next one is: what the rows above and
// below share of their surroundings is still in the cache then. A whole layer of 10^7 points would not be.
constexpr std::int64_t kStrip = 16;

// Rows of a bundle along y and z, and bins along it in which clusters stand in the order of their rows: sixteen
// clusters in a row are about as long as wide.
constexpr std::int64_t kBundleRows2d = 4, kBundleRows3d = 2, kBundleBins = 2;
static_assert(kStrip % kBundleRows2d == 0 && kStrip % kBundleRows3d == 0);

// Boxes of the grid of blocks (z, y, x): as wide as a bundle, and about as long.
constexpr std::array<int, 3> kBoxShift2d{0, 2, 4}, kBoxShift3d{1, 1, 3};
static_assert(kBundleRows2d == 4 && kBundleRows3d == 2);

// How many rows come before the one in this layer, strip by strip of so many rows, each layer by layer, to and fro.
// goes_back: does the layer?
std::int64_t rows_before(std::int64_t layer, std::int64_t row, std::int64_t layers, std::int64_t rows,
                         std::int64_t strip_rows, bool goes_back) {
    const std::int64_t strip = row / strip_rows, first = strip * strip_rows, end = std::min(first + strip_rows, rows);
    const std::int64_t layers_before = (strip & 1) != 0 ? layers - 1 - layer : layer;
    return first * layers + layers_before * (end - first) + (goes_back ? end - 1 - row : row - first);
}

}  // namespace

void ClusterOrder::build(const VectorField& x, const std::vector<Index>& id, int dimensions, double spacing,
                         const Domain& domain) {
    const double width = (dimensions == 3 ? kRowWidth3d : kRowWidth2d) * spacing;
    const double length = (dimensions == 3 ? kBinLength3d : kBinLength2d) * spacing;
    division_.divide(dimensions, {length, width, width}, domain);
    count_ = id.size();
    range_ = division_.range_of(x, count_);
    order_.resize(count_);
    const bool dense = is_dense();
    if (dense) {
        order_dense(x, id);
    } else {
        order_sparse(x, id);
    }
    store_in_bundles(x, dense);
    blocks_.build(division_, range_, dimensions == 3 ? kBoxShift3d : kBoxShift2d, x, order_,
                  kBlockClusters * kClusterSize);
}

Bin ClusterOrder::in_walking_order(const Bin& bin) {
    const auto [z, y, x] = bin;
    return {z, (z & 1) != 0 ? -y : y, ((z + y) & 1) != 0 ? -x : x};
}

std::size_t ClusterOrder::number_of(const Bin& bin) const {
    const auto [z, y, x] = bin;
    const auto& [lowest, highest] = range_;
    const std::int64_t before =
        rows_before(z - lowest[0], y - lowest[1], range_.width(0), range_.width(1), kStrip, (z & 1) != 0);
    const std::int64_t place = ((z + y) & 1) != 0 ? highest[2] - x : x - lowest[2];
    return static_cast<std::size_t>(range_.width(2) * before + place);
}

bool ClusterOrder::is_dense() const {
    return range_.bins() <= static_cast<double>(std::max(kDenseMinimum, kDenseBins * count_));
}

// Counting sort. Places within a bin are handed out in any order, then ids decide.
void ClusterOrder::order_dense(const VectorField& x, const std::vector<Index>& id) {
    const std::size_t count = id.size();
    std::vector<Index> start(static_cast<std::size_t>(range_.width(0) * range_.width(1) * range_.width(2)) + 1, 0);
    std::vector<Index> numbers(count);  // of each point's bin
    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t number = number_of(division_.find(x, i));
            numbers[i] = static_cast<Index>(number);
#pragma omp atomic
            ++start[number];
        }
    });
    Index sum = 0;
    for (Index& of_bin : start) {
        sum += of_bin;
        of_bin = sum;  // the end, from which places are handed out
    }
    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            Index place;
#pragma omp atomic capture
            place = --start[numbers[i]];
            order_[place] = static_cast<Index>(i);
        }
    });
    parallel_for(start.size() - 1, 4 * kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        const auto by_id = [&](Index a, Index b) { return id[a] < id[b]; };
        for (std::size_t bin = begin; bin < end; ++bin) {
            if (start[bin + 1] - start[bin] > 1)
                std::sort(order_.begin() + start[bin], order_.begin() + start[bin + 1], by_id);
        }
    });
}

void ClusterOrder::order_sparse(const VectorField& x, const std::vector<Index>& id) {
    const std::size_t count = id.size();
    std::vector<Bin> bin_of(count);
    for (std::size_t i = 0; i < count; ++i) {
        bin_of[i] = in_walking_order(division_.find(x, i));
        order_[i] = static_cast<Index>(i);
    }
    std::sort(order_.begin(), order_.end(),
              [&](Index a, Index b) { return bin_of[a] != bin_of[b] ? bin_of[a] < bin_of[b] : id[a] < id[b]; });
}

Bin ClusterOrder::bundle_of(const Bin& first, const Bin& last) const {
    const bool is_3d = division_.dimensions() == 3;
    const Bin& lowest = range_.lowest;
    return {(first[0] - lowest[0]) / (is_3d ? kBundleRows3d : 1),
            (first[1] - lowest[1]) / (is_3d ? kBundleRows3d : kBundleRows2d),
            (first[2] - lowest[2] + last[2] - lowest[2]) / (2 * kBundleBins)};
}

// The last cluster stays the last, since it may have fewer points.
void ClusterOrder::store_in_bundles(const VectorField& x, bool is_dense) {
    if (count_ == 0) return;
    std::vector<Bin> bundles(clusters() - 1);
    parallel_for(bundles.size(), kParticleBlock, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t c = first; c < last; ++c) {
            const Index* of_cluster = &order_[c * kClusterSize];
            bundles[c] = bundle_of(division_.find(x, of_cluster[0]), division_.find(x, of_cluster[kClusterSize - 1]));
        }
    });
    const std::vector<Index> place = is_dense ? place_dense(bundles) : place_sparse(bundles);
    std::vector<Index> along_rows(order_.begin(), order_.end());
    parallel_for(bundles.size(), kParticleBlock, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t c = first; c < last; ++c)
            std::copy_n(&along_rows[c * kClusterSize], kClusterSize, &order_[place[c] * kClusterSize]);
    });
}

// Counting sort; those of the same number stay in their order.
std::vector<Index> ClusterOrder::place_dense(const std::vector<Bin>& bundles) const {
    const Bin highest = bundle_of(range_.highest, range_.highest);
    const std::int64_t layers = highest[0] + 1, rows = highest[1] + 1, length = highest[2] + 1;
    const std::int64_t strip_rows = kStrip / (division_.dimensions() == 3 ? kBundleRows3d : kBundleRows2d);
    std::vector<Index> number(bundles.size());
    parallel_for(bundles.size(), kParticleBlock, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t c = first; c < last; ++c) {
            const auto [z, y, x] = bundles[c];
            const std::int64_t before = rows_before(z, y, layers, rows, strip_rows, (z & 1) != 0);
            number[c] = static_cast<Index>(before * length + (((z + y) & 1) != 0 ? length - 1 - x : x));
        }
    });
    std::vector<Index> next(static_cast<std::size_t>(layers * rows * length) + 1, 0);
    for (const Index n : number) ++next[n + 1];
    for (std::size_t n = 1; n < next.size(); ++n) next[n] += next[n - 1];
    for (Index& n : number) n = next[n]++;
    return number;
}

std::vector<Index> ClusterOrder::place_sparse(const std::vector<Bin>& bundles) {
    std::vector<Index> clusters(bundles.size()), place(bundles.size());
    for (std::size_t c = 0; c < clusters.size(); ++c) clusters[c] = static_cast<Index>(c);
    std::stable_sort(clusters.begin(), clusters.end(),
                     [&](Index a, Index b) { return in_walking_order(bundles[a]) < in_walking_order(bundles[b]); });
    for (std::size_t n = 0; n < clusters.size(); ++n) place[clusters[n]] = static_cast<Index>(n);
    return place;
}

}  // namespace headrace::solver
