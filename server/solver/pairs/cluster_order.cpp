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
    dimensions_ = dimensions;
    divide(spacing, domain);
    count_ = id.size();
    order_.resize(count_);
    bin_of_point_.clear();
    measure(x, id.size());
    if (is_dense_) {
        order_dense(x, id);
    } else {
        order_sparse(x, id);
    }
    store_in_bundles(x);
}

// Along a periodic axis whole bins fill the period.
void ClusterOrder::divide(double spacing, const Domain& domain) {
    const double width = dimensions_ == 3 ? kRowWidth3d : kRowWidth2d;
    const double length = dimensions_ == 3 ? kBinLength3d : kBinLength2d;
    for (int axis = 0; axis < 3; ++axis) {
        side_[axis] = (axis == 0 ? length : width) * spacing;
        origin_[axis] = period_[axis] = 0.0;
        bins_in_period_[axis] = 0;
        if (domain.periodic[axis] && axis < dimensions_) {
            origin_[axis] = domain.min[axis];
            period_[axis] = domain.max[axis] - domain.min[axis];
            const double whole = std::max(1.0, std::floor(period_[axis] / side_[axis]));
            bins_in_period_[axis] = static_cast<std::int64_t>(whole);
            side_[axis] = period_[axis] / whole;
        }
        inv_side_[axis] = 1.0 / side_[axis];
    }
}

ClusterOrder::Bin ClusterOrder::find_bin(const VectorField& x, std::size_t i) const {
    Bin bin{};
    for (int axis = 0; axis < dimensions_; ++axis) {
        std::int64_t& c = bin[2 - axis];
        c = coordinate(x[axis][i], axis);
        if (bins_in_period_[axis] > 0)  // rounding at the very end
            c = std::clamp<std::int64_t>(c, 0, bins_in_period_[axis] - 1);
    }
    return bin;
}

ClusterOrder::Bin ClusterOrder::in_walking_order(const Bin& bin) {
    const auto [z, y, x] = bin;
    return {z, (z & 1) != 0 ? -y : y, ((z + y) & 1) != 0 ? -x : x};
}

std::size_t ClusterOrder::number_of(const Bin& bin) const {
    const auto [z, y, x] = bin;
    const std::int64_t before = rows_before(z - lowest_[0], y - lowest_[1], highest_[0] - lowest_[0] + 1,
                                            highest_[1] - lowest_[1] + 1, kStrip, (z & 1) != 0);
    const std::int64_t place = ((z + y) & 1) != 0 ? highest_[2] - x : x - lowest_[2];
    return row_ * static_cast<std::size_t>(before) + static_cast<std::size_t>(place);
}

// The box of bins that the points occupy, and which layout it allows.
void ClusterOrder::measure(const VectorField& x, std::size_t count) {
    struct Range {
        Bin lowest, highest;
    };
    const Range none{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
    const auto join = [](Range a, const Range& b) {
        for (int k = 0; k < 3; ++k) {
            a.lowest[k] = std::min(a.lowest[k], b.lowest[k]);
            a.highest[k] = std::max(a.highest[k], b.highest[k]);
        }
        return a;
    };
    const Range range = parallel_reduce(
        count, none,
        [&](std::size_t begin, std::size_t end) {
            Range block = none;
            for (std::size_t i = begin; i < end; ++i) {
                const Bin bin = find_bin(x, i);
                block = join(block, {bin, bin});
            }
            return block;
        },
        join);
    lowest_ = count > 0 ? range.lowest : Bin{};
    highest_ = count > 0 ? range.highest : Bin{};
    // In floating point, since the product may exceed any integer.
    std::array<double, 3> width{};
    for (int k = 0; k < 3; ++k) width[k] = static_cast<double>(highest_[k] - lowest_[k]) + 1.0;
    const std::size_t allowed = std::max(kDenseMinimum, kDenseBins * count);
    is_dense_ = width[0] * width[1] * width[2] <= static_cast<double>(allowed);
    if (!is_dense_) return;
    row_ = static_cast<std::size_t>(width[2]);
    layer_ = row_ * static_cast<std::size_t>(width[1]);
    start_.assign(layer_ * static_cast<std::size_t>(width[0]) + 1, 0);
}

// Counting sort. Places within a bin are handed out in any order, then ids decide.
void ClusterOrder::order_dense(const VectorField& x, const std::vector<Index>& id) {
    const std::size_t count = id.size();
    std::vector<Index> numbers(count);  // of each point's bin
    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t number = number_of(find_bin(x, i));
            numbers[i] = static_cast<Index>(number);
#pragma omp atomic
            ++start_[number];
        }
    });
    Index sum = 0;
    for (Index& start : start_) {
        sum += start;
        start = sum;  // the end, from which places are handed out
    }
    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            Index place;
#pragma omp atomic capture
            place = --start_[numbers[i]];
            order_[place] = static_cast<Index>(i);
        }
    });
    parallel_for(start_.size() - 1, 4 * kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        const auto by_id = [&](Index a, Index b) { return id[a] < id[b]; };
        for (std::size_t bin = begin; bin < end; ++bin) {
            if (start_[bin + 1] - start_[bin] > 1)
                std::sort(order_.begin() + start_[bin], order_.begin() + start_[bin + 1], by_id);
        }
    });
}

void ClusterOrder::order_sparse(const VectorField& x, const std::vector<Index>& id) {
    const std::size_t count = id.size();
    std::vector<Bin> bin_of(count);
    for (std::size_t i = 0; i < count; ++i) {
        bin_of[i] = in_walking_order(find_bin(x, i));
        order_[i] = static_cast<Index>(i);
    }
    std::sort(order_.begin(), order_.end(),
              [&](Index a, Index b) { return bin_of[a] != bin_of[b] ? bin_of[a] < bin_of[b] : id[a] < id[b]; });
    bin_of_point_.resize(count);
    for (std::size_t point = 0; point < count; ++point) bin_of_point_[point] = bin_of[order_[point]];
}

ClusterOrder::Bin ClusterOrder::bundle_of(const Bin& first, const Bin& last) const {
    const bool is_3d = dimensions_ == 3;
    return {(first[0] - lowest_[0]) / (is_3d ? kBundleRows3d : 1),
            (first[1] - lowest_[1]) / (is_3d ? kBundleRows3d : kBundleRows2d),
            (first[2] - lowest_[2] + last[2] - lowest_[2]) / (2 * kBundleBins)};
}

// The last cluster stays the last, since it may have fewer points.
void ClusterOrder::store_in_bundles(const VectorField& x) {
    cluster_at_.resize(clusters());
    if (count_ == 0) return;
    cluster_at_.back() = static_cast<Index>(clusters() - 1);
    std::vector<Bin> bundles(clusters() - 1);
    parallel_for(bundles.size(), kParticleBlock, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t c = first; c < last; ++c) {
            const Index* of_cluster = &order_[c * kClusterSize];
            bundles[c] = bundle_of(find_bin(x, of_cluster[0]), find_bin(x, of_cluster[kClusterSize - 1]));
        }
    });
    if (is_dense_) {
        place_dense(bundles);
    } else {
        place_sparse(bundles);
    }
    std::vector<Index> along_rows(order_.begin(), order_.end());
    parallel_for(bundles.size(), kParticleBlock, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t c = first; c < last; ++c)
            std::copy_n(&along_rows[c * kClusterSize], kClusterSize, &order_[cluster_at_[c] * kClusterSize]);
    });
}

// Counting sort; those of the same number stay in their order.
void ClusterOrder::place_dense(const std::vector<Bin>& bundles) {
    const Bin highest = bundle_of(highest_, highest_);
    const std::int64_t layers = highest[0] + 1, rows = highest[1] + 1, length = highest[2] + 1;
    const std::int64_t strip_rows = kStrip / (dimensions_ == 3 ? kBundleRows3d : kBundleRows2d);
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
    for (std::size_t c = 0; c < number.size(); ++c) cluster_at_[c] = next[number[c]]++;
}

void ClusterOrder::place_sparse(const std::vector<Bin>& bundles) {
    std::vector<Index> clusters(bundles.size());
    for (std::size_t c = 0; c < clusters.size(); ++c) clusters[c] = static_cast<Index>(c);
    std::stable_sort(clusters.begin(), clusters.end(),
                     [&](Index a, Index b) { return in_walking_order(bundles[a]) < in_walking_order(bundles[b]); });
    for (std::size_t place = 0; place < clusters.size(); ++place)
        cluster_at_[clusters[place]] = static_cast<Index>(place);
}

RowRun ClusterOrder::find_run(std::int64_t z, std::int64_t y, std::int64_t first, std::int64_t last) const {
    first = std::max(first, lowest_[2]);
    last = std::min(last, highest_[2]);
    if (first > last) return {};
    const bool goes_back = ((z + y) & 1) != 0;
    const Bin from{z, y, goes_back ? last : first}, to{z, y, goes_back ? first : last};
    if (is_dense_) return {start_[number_of(from)], start_[number_of(to) + 1], {}};
    const auto number = [&](auto found) { return static_cast<Index>(found - bin_of_point_.begin()); };
    return {number(std::lower_bound(bin_of_point_.begin(), bin_of_point_.end(), in_walking_order(from))),
            number(std::upper_bound(bin_of_point_.begin(), bin_of_point_.end(), in_walking_order(to))),
            {}};
}

}  // namespace headrace::solver
