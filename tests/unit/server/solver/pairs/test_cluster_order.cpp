#include <catch2/catch.hpp>
#include <set>

#include "points.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

// Points in a box, in one that two axes go through the ends of, and in drops so far apart that a table of all bins
// between them would not fit.
Points make_points(const std::string& kind, int dimensions) {
    Points points;
    points.dimensions = dimensions;
    if (kind == "drops") {
        points.fill(200, {0, 0, 0}, {5, 5, 5}, 3);
        points.fill(200, {4000, -7000, 3000}, {4005, -6995, 3005}, 4);
        points.fill(50, {-1e5, -1e5, -1e5}, {1e5, 1e5, 1e5}, 5);
    } else {
        points.fill(700, {0, 0, 0}, {13, 12, 11}, 7);
        if (kind == "periods") points.domain = {{0, 0, 0}, {13, 12, 11}, {true, true, false}};
    }
    points.sort();
    return points;
}

}  // namespace

TEST_CASE("ClusterOrder.HoldsEveryPointOnceInAnOrderOfItsPlaceAlone") {
    const int dimensions = GENERATE(2, 3);
    const std::string kind = GENERATE("box", "periods", "drops");
    const Points points = make_points(kind, dimensions);
    CHECK(std::set<Index>(points.id.begin(), points.id.end()).size() == points.size());
    // Handed in the other way round, and again in its own order.
    Points reversed = points;
    for (int k = 0; k < dimensions; ++k) std::reverse(reversed.x[k].begin(), reversed.x[k].end());
    std::reverse(reversed.id.begin(), reversed.id.end());
    reversed.sort();
    CHECK(reversed.id == points.id);
}

TEST_CASE("ClusterOrder.BlocksNearABoxHoldAllPointsWithinReachOfIt") {
    const int dimensions = GENERATE(2, 3);
    const std::string kind = GENERATE("box", "periods", "drops");
    const Points points = make_points(kind, dimensions);
    const double reach = 2.5;
    constexpr std::size_t kBlock = kBlockClusters * kClusterSize;
    std::size_t near = 0, left_out = 0;
    for (std::size_t i = 0; i < points.size(); i += 7) {
        std::set<std::pair<std::array<int, 3>, Index>> blocks;
        std::vector<std::array<int, 3>> images;
        points.order.blocks().for_each_near(points.at(i), points.at(i), reach,
                                            [&](Index block, const std::array<int, 3>& image) {
                                                blocks.insert({image, block});
                                                if (images.empty() || images.back() != image) images.push_back(image);
                                            });
        CHECK(std::set<std::array<int, 3>>(images.begin(), images.end()).size() == images.size());
        std::set<std::size_t> found;
        for (const auto& [image, block] : blocks) {
            for (std::size_t j = kBlock * block; j < std::min(kBlock * (block + 1), points.size()); ++j) {
                double r2 = 0.0;
                for (int k = 0; k < dimensions; ++k) {
                    const double d = points.x[k][i] - points.x[k][j] - image[k] * points.period()[k];
                    r2 += d * d;
                }
                // Twice under one image would be counted twice.
                if (r2 < reach * reach) CHECK(found.insert(j).second);
            }
        }
        for (std::size_t j = 0; j < points.size(); ++j) {
            const bool is_near = points.distance(i, j) < reach;
            near += is_near;
            CHECK(is_near == (found.count(j) == 1));
        }
        left_out += (points.size() + kBlock - 1) / kBlock - std::min(blocks.size(), points.size() / kBlock);
    }
    CHECK(near > 2 * points.size() / 7);
    CHECK(left_out > 0);  // not simply all of them
}

TEST_CASE("ClusterOrder.ClustersOfABodyAreCompact") {
    // Four of a lattice one spacing apart: of a row 1.8 wide, so at most two rows of 1.8 and some bins across.
    Points points;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            for (int k = 0; k < 20; ++k) points.add({i + 0.5, j + 0.5, k + 0.5});
    points.sort();
    double mean = 0.0;
    for (std::size_t c = 0; c < points.order.clusters(); ++c) {
        for (int k = 0; k < 3; ++k) {
            const auto first = points.x[k].begin() + static_cast<std::ptrdiff_t>(4 * c);
            const auto [low, high] = std::minmax_element(first, first + 4);
            mean += (*high - *low) / static_cast<double>(3 * points.order.clusters());
        }
    }
    CHECK(mean < 1.5);  // in a random order it would be 12
}

TEST_CASE("ClusterOrder.BlocksOfABodyAreCompact") {
    // Sixteen clusters of a lattice one spacing apart hold 64 points. Rows of single clusters would be 20 long in 3D
    // and 32 in 2D; bundles are as long as their points fill, 64/3.6^2 = 4.9 and 64/8 = 8, and up to two clusters more
    // where rows have got out of step. At the walls of the box bundles are thinner and blocks longer: the mean is
    // taken.
    const int dimensions = GENERATE(2, 3);
    Points points;
    points.dimensions = dimensions;
    const int edge = dimensions == 2 ? 80 : 22, layers = dimensions == 2 ? 1 : 22;
    for (int i = 0; i < edge; ++i)
        for (int j = 0; j < edge; ++j)
            for (int k = 0; k < layers; ++k) points.add({i + 0.5, j + 0.5, k + 0.5});
    points.sort();
    constexpr std::size_t kBlock = kBlockClusters * kClusterSize;
    const std::size_t blocks = points.size() / kBlock;
    double longest = 0.0;
    for (std::size_t b = 0; b < blocks; ++b) {
        double extent = 0.0;
        for (int k = 0; k < dimensions; ++k) {
            const auto first = points.x[k].begin() + static_cast<std::ptrdiff_t>(kBlock * b);
            const auto [low, high] = std::minmax_element(first, first + kBlock);
            extent = std::max(extent, *high - *low);
        }
        longest += extent / static_cast<double>(blocks);
    }
    CHECK(longest < (dimensions == 2 ? 12.0 : 8.0));
}
