// No pair is ever missed, however the points move while the lists are reused.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <vector>

#include "points.h"
#include "server/solver/pairs/instruction_sets.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

constexpr double kSupport = 3.0, kSkin = 0.4, kInnerSkin = 0.15;

NeighbourInput input_of(const Points& fluid, const Points* walls = nullptr) {
    NeighbourInput in;
    in.dimensions = fluid.dimensions;
    in.fluid = fluid.ordered();
    if (walls != nullptr) in.walls = walls->ordered();
    in.reach = {kSupport, kSkin, kInnerSkin, fluid.period(), nullptr};
    return in;
}

// visit(i, j, r2) for all pairs of points that the loops meet, as they see them: relative places and the way's offset.
template <class S, class Visit>
void for_each_met(const PairList<S>& list, const ClusterPoints<S>& centres, const ClusterPoints<S>& neighbours,
                  Visit&& visit) {
    for (std::size_t b = 0; b < list.blocks().size(); ++b) {
        const PairBlock<S>& block = list.blocks()[b];
        block.for_each_met([&](std::size_t place, Index cluster, Index e) {
            const std::size_t c = b * kBlockClusters + place;
            const PairWay<S>& way = block.way(block.rows[place], e);
            for (std::size_t k = 0; k < 16; ++k) {
                const std::size_t i = 4 * c + k / 4, j = 4 * cluster + k % 4;
                if (i >= centres.size() || j >= neighbours.size()) continue;
                double r2 = 0.0;
                for (int axis = 0; axis < centres.dimensions(); ++axis) {
                    const double d = centres.record(c)[4 * axis + k / 4] + way.offset[axis] -
                                     neighbours.record(cluster)[4 * axis + k % 4];
                    r2 += d * d;
                }
                visit(i, j, r2);
            }
        });
    }
}

// Pairs of points (centre, neighbour) nearer than `within` that the list leads to, with how often.
template <class S>
std::map<std::pair<std::size_t, std::size_t>, int> listed_pairs(const PairList<S>& list,
                                                                const ClusterPoints<S>& centres,
                                                                const ClusterPoints<S>& neighbours,
                                                                double within = kSupport) {
    std::map<std::pair<std::size_t, std::size_t>, int> pairs;
    for_each_met(list, centres, neighbours, [&](std::size_t i, std::size_t j, double r2) {
        if (r2 < within * within) ++pairs[{i, j}];
    });
    return pairs;
}

// Every pair within the support, or another distance, once; pairs at its very edge may go either way.
template <class S>
void check_complete(const PairNeighboursOf<S>& neighbours, const Points& points, double within = kSupport) {
    constexpr double kEdge = 1e-5;  // rounding of relative places, a hundred spacings at most
    const auto pairs = listed_pairs(neighbours.among_fluid(), neighbours.fluid(), neighbours.fluid(), within);
    std::size_t missing = 0, wrong = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < points.size(); ++j) {
            const double r = points.distance(i, j);
            const auto found = pairs.find({i, j});
            const int count = found == pairs.end() ? 0 : found->second;
            missing += r < within - kEdge && count != 1;
            wrong += r > within + kEdge && count != 0;
        }
    }
    CHECK(missing == 0);
    CHECK(wrong == 0);
}

Points make_body(const std::string& kind, int dimensions) {
    Points points;
    points.dimensions = dimensions;
    if (kind == "spray") {
        points.fill(300, {0, 0, 0}, {9, 9, 9}, 11);
        points.fill(30, {-2e4, -2e4, -2e4}, {2e4, 2e4, 2e4}, 12);
    } else if (kind == "spray about a corner of periods") {
        for (const double x : {0.0, 391.0})
            for (const double y : {0.0, 391.0}) points.fill(60, {x, y, 0}, {x + 9, y + 9, 9}, 14);
        points.fill(40, {0, 0, 0}, {400, 400, 9}, 15);
        points.domain = {{0, 0, -1e9}, {400, 400, 1e9}, {true, true, false}};
    } else {
        points.fill(500, {0, 0, 0}, {11, 10, 9.5}, 13);
        if (kind == "periods") points.domain = {{0, 0, 0}, {11, 10, 9.5}, {true, false, true}};
    }
    points.sort();
    return points;
}

}  // namespace

TEST_CASE("PairList.HasEveryPairWithinTheSupportAndItsSkinOnce") {
    const int dimensions = GENERATE(2, 3);
    const std::string kind = GENERATE("body", "periods", "spray", "spray about a corner of periods");
    const Points points = make_body(kind, dimensions);
    PairNeighboursOf<double> neighbours;
    NeighbourInput in = input_of(points);
    in.reach.inner_skin = kSkin;
    neighbours.find(in);
    check_complete(neighbours, points);
    check_complete(neighbours, points, kSupport + kSkin);
}

TEST_CASE("PairList.HalfHasEveryPairOnceAndEachClusterFirstWithItself") {
    const int dimensions = GENERATE(2, 3);
    const std::string kind = GENERATE("body", "periods", "spray", "spray about a corner of periods");
    const Points points = make_body(kind, dimensions);
    PairNeighboursOf<double> neighbours;
    NeighbourInput in = input_of(points);
    in.reach.is_half = true;
    neighbours.find(in);
    std::size_t others_first = 0;
    for (std::size_t c = 0; c < neighbours.fluid().clusters(); ++c) {
        const PairBlock<double>& block = neighbours.among_fluid().blocks()[c / kBlockClusters];
        const PairRow& row = block.rows[c % kBlockClusters];
        others_first += row.begin == row.end || block.cluster(row, row.begin) != c;
    }
    CHECK(others_first == 0);
    const double within = kSupport + kInnerSkin;
    const auto pairs = listed_pairs(neighbours.among_fluid(), neighbours.fluid(), neighbours.fluid(), within);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double r = points.distance(i, j);
            if (std::abs(r - within) < 1e-5) continue;
            const auto times = [&](std::size_t a, std::size_t b) {
                const auto found = pairs.find({a, b});
                return found == pairs.end() ? 0 : found->second;
            };
            // Both ways within a cluster, unless it is a period's displacement that brings them together.
            double r2 = 0.0;
            for (int k = 0; k < dimensions; ++k) r2 += std::pow(points.x[k][i] - points.x[k][j], 2);
            const int expected = r > within ? 0 : (i / 4 == j / 4 && r2 < within * within ? 2 : 1);
            wrong += times(i, j) + times(j, i) != expected;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("PairList.PruningKeepsEveryPairWithinTheSupportAndTheInnerSkin") {
    const int dimensions = GENERATE(2, 3);
    const std::string kind = GENERATE("body", "periods", "spray");
    const Points points = make_body(kind, dimensions);
    PairNeighboursOf<double> all, pruned;
    NeighbourInput in = input_of(points);
    pruned.find(in);
    in.reach.inner_skin = kSkin;
    all.find(in);
    check_complete(pruned, points, kSupport + kInnerSkin);
    CHECK(pruned.neighbours_per_particle() < all.neighbours_per_particle());
}

TEST_CASE("PairList.IsMadeAsPruningItForTheSamePlacesLeavesIt") {
    const int dimensions = GENERATE(2, 3);
    const std::string kind = GENERATE("body", "periods", "spray");
    const bool is_half = GENERATE(false, true);
    const std::string set = GENERATE(from_range(instruction_sets()));
    INFO(kind << " in " << set);
    const OnlyInstructionSet only(set);
    const Points points = make_body(kind, dimensions);
    PairNeighboursOf<float> neighbours;
    NeighbourInput in = input_of(points);
    in.reach.is_half = is_half;
    neighbours.find(in);
    const PairList<float>& made = neighbours.among_fluid();
    PairList<float> pruned = made;
    pruned.bring_back();
    REQUIRE(!pruned.is_pruned());
    REQUIRE(pruned.entries() > made.entries());
    pruned.prune(neighbours.fluid(), neighbours.fluid());
    CHECK(made.is_pruned());
    REQUIRE(pruned.blocks().size() == made.blocks().size());
    for (std::size_t b = 0; b < made.blocks().size(); ++b) {
        const PairBlock<float>&one = made.blocks()[b], &other = pruned.blocks()[b];
        CHECK(one.entries == other.entries);
        for (std::size_t c = 0; c < kBlockClusters; ++c) CHECK(one.rows[c].end == other.rows[c].end);
    }
}

TEST_CASE("PairList.HasThePairsOfMoreClustersThanAnEntryHasNumbersFor") {
    constexpr int kEdge = 520;
    constexpr double kWithin = 2.9;
    Points points;
    points.dimensions = 2;
    for (int y = 0; y < kEdge; ++y)
        for (int x = 0; x < kEdge; ++x) points.add({1.0 * x, 1.0 * y, 0.0});
    points.sort();
    PairNeighboursOf<float> neighbours;
    neighbours.find(input_of(points));
    REQUIRE(neighbours.fluid().clusters() > kMostWays * kBlockClusters);
    std::size_t pairs = 0, wrong = 0;
    const ClusterPoints<float>& fluid = neighbours.fluid();
    for_each_met(neighbours.among_fluid(), fluid, fluid, [&](std::size_t i, std::size_t j, double r2) {
        if (r2 > kWithin * kWithin) return;
        ++pairs;
        wrong += std::abs(std::sqrt(r2) - points.distance(i, j)) > 1e-4;
    });
    std::size_t expected = 0;
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) expected += std::size_t(kEdge - std::abs(x)) * std::size_t(kEdge - std::abs(y));
    }
    CHECK(pairs == expected);  // all with |x|, |y| <= 2: 8 < 2.9^2 < 9
    CHECK(wrong == 0);
}

TEST_CASE("PairList.HasThePairsOfClustersAsWideAsTheScene") {
    // One of a cluster's points just within reach of another's, the others where float places are hundredths apart:
    // boxes around them round by more than the pair has left.
    constexpr double kReach = kSupport + kSkin;
    for (int trial = 0; trial < 200; ++trial) {
        Points points;
        points.dimensions = 2;
        const double far = 2e5 + 777.77 * trial, x = 0.003 * trial;
        points.add({x, 0, 0});
        points.add({x + kReach - 1e-4, 0, 0});
        for (int k = 1; k <= 3; ++k) {
            points.add({-k * far, 0, 0});
            points.add({k * far + 0.1, 0, 0});
        }
        points.sort();
        PairNeighboursOf<double> neighbours;
        NeighbourInput in = input_of(points);
        in.reach.inner_skin = kSkin;
        neighbours.find(in);
        INFO("trial " << trial);
        check_complete(neighbours, points, kReach);
    }
}

TEST_CASE("PairList.MissesNoPairAsLongAsItSaysSo") {
    // A carried, turning and shaken body: lists are kept until cover() gives them up.
    const int dimensions = GENERATE(2, 3);
    const std::string kind = GENERATE("body", "periods");
    Points points = make_body(kind, dimensions);
    PairNeighboursOf<float> neighbours;
    neighbours.find(input_of(points));
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> shake(-0.02, 0.02);
    int kept = 0;
    for (int step = 0; step < 100; ++step) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double x = points.x[0][i], y = points.x[1][i];
            points.x[0][i] += 0.3 - 0.004 * (y - 5.0) + shake(random);
            points.x[1][i] += 0.004 * (x - 5.0 - 0.3 * step) + shake(random);
        }
        if (!neighbours.move_fluid(points.x, points.V.data())) break;
        ++kept;
        check_complete(neighbours, points);
    }
    CHECK(kept >= 2);   // a body carried 0.3 a step alone would have worn out a skin of 0.4 at once
    CHECK(kept < 100);  // and shaking wears it out in the end
}

TEST_CASE("PairList.BringsBackPrunedPairsThatComeNear") {
    // Two bodies that approach each other by less than the skin, in steps longer than the inner one: pairs between them
    // are listed from the start, pruned away, and needed in the end.
    const int dimensions = GENERATE(2, 3);
    Points points;
    points.dimensions = dimensions;
    for (int k = 0; k < 150; ++k) {
        const double x = k % 5, y = k / 5 % 5, z = dimensions == 3 ? k / 25 : 0.05 * (k / 25);
        points.add({x, y, z});
        points.add({x + 7.2, y, z});  // 3.2 between them
    }
    points.sort();
    PairNeighboursOf<float> neighbours;
    neighbours.find(input_of(points));
    const auto across = [&] {
        std::size_t count = 0;
        for (const auto& [pair, times] : listed_pairs(neighbours.among_fluid(), neighbours.fluid(), neighbours.fluid()))
            count += (points.x[0][pair.first] < 5.5) != (points.x[0][pair.second] < 5.5);
        return count;
    };
    CHECK(across() == 0);
    for (int step = 0; step < 2; ++step) {
        for (std::size_t i = 0; i < points.size(); ++i) points.x[0][i] += points.x[0][i] < 5.5 ? 0.09 : -0.09;
        REQUIRE(neighbours.move_fluid(points.x, points.V.data()));
        check_complete(neighbours, points);
    }
    CHECK(across() > 0);
}

TEST_CASE("PairList.HoldsForAMotionOfItsSkinAndNotForMore") {
    // Two bodies that close in by the skin. Just within the lists' reach at the start their pairs are listed, and met
    // at the end; just out of it they are not, and a criterion that let them go on would miss them.
    const int dimensions = GENERATE(2, 3);
    const double beyond = GENERATE(-1e-3, 1e-3);                    // the reach
    constexpr double kLeft = 3.0, kRight = 3.0 + kSupport + kSkin;  // where one body ends and the other begins
    constexpr double kMiddle = 0.5 * (kLeft + kRight);
    Points points;
    points.dimensions = dimensions;
    for (int k = 0; k < 160; ++k) {
        const double x = k % 4, y = dimensions == 3 ? k / 4 % 5 : k / 4, z = dimensions == 3 ? k / 20 : 0;
        points.add({x, y, z});
        points.add({x + kRight + beyond, y, z});
    }
    points.sort();
    NeighbourInput in = input_of(points);
    in.reach.inner_skin = kSkin;  // none is pruned
    PairNeighboursOf<float> neighbours;
    neighbours.find(in);
    const auto close_in = [&](double way) {  // both by half of it
        for (double& x : points.x[0]) x += x < kMiddle ? 0.5 * way : -0.5 * way;
        return neighbours.move_fluid(points.x, points.V.data());
    };
    const auto pairs_across = [&] {  // within the support
        std::vector<std::pair<std::size_t, std::size_t>> pairs;
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = 0; j < points.size(); ++j)
                if (points.x[0][i] < kMiddle && points.x[0][j] > kMiddle && points.distance(i, j) < kSupport)
                    pairs.emplace_back(i, j);
        return pairs;
    };
    REQUIRE(close_in(kSkin - 0.5e-3));
    check_complete(neighbours, points);
    CHECK(pairs_across().empty() == (beyond > 0.0));
    CHECK_FALSE(close_in(2e-3));
    const auto listed = listed_pairs(neighbours.among_fluid(), neighbours.fluid(), neighbours.fluid());
    const auto near = pairs_across();
    REQUIRE_FALSE(near.empty());
    const bool has_all = std::all_of(near.begin(), near.end(), [&](const auto& pair) { return listed.contains(pair); });
    CHECK(has_all == (beyond < 0.0));  // whole clusters are listed: some are there by their neighbours
}

TEST_CASE("PairList.MendsTheListsOfAFewThatOutrunTheirSkin") {
    // A drop flies at a corner of a large body at rest, from out of reach, by several skins.
    const int dimensions = GENERATE(2, 3);
    const bool has_spray = GENERATE(false, true);  // far away, so that the drop's block is as wide as the scene
    constexpr Index kBody = 25000, kDrop = 16;
    Points points;
    points.dimensions = dimensions;
    points.fill(kBody, {0, 0, 0}, dimensions == 2 ? Vec3{150, 167, 0} : Vec3{10, 50, 50}, 37);
    points.fill(kDrop, {-5.6, 1, 1}, {-3.6, 5, 3}, 38);  // 3.6 between them: the support and skin are 3.4
    if (has_spray) points.fill(3, {-2e4, -2e4, -2e4}, {-1e4, -1e4, -1e4}, 39);
    points.sort();
    PairNeighboursOf<float> neighbours;
    neighbours.find(input_of(points));
    const auto is_drop = [&](std::size_t i) { return points.id[i] >= kBody && points.id[i] < kBody + kDrop; };
    const double kEdge = has_spray ? 1e-2 : 1e-5;  // rounding of relative places
    std::size_t met = 0;
    for (int step = 0; step < 9; ++step) {
        for (std::size_t i = 0; i < points.size(); ++i) points.x[0][i] += is_drop(i) ? 0.17 : 0.0;
        REQUIRE(neighbours.move_fluid(points.x, points.V.data()));
        std::map<std::pair<std::size_t, std::size_t>, int> times;
        for_each_met(neighbours.among_fluid(), neighbours.fluid(), neighbours.fluid(),
                     [&](std::size_t i, std::size_t j, double r2) {
                         if (is_drop(i) != is_drop(j) && r2 < kSupport * kSupport) ++times[{i, j}];
                     });
        std::size_t wrong = 0;
        met = times.size();
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!is_drop(i)) continue;
            for (std::size_t j = 0; j < points.size(); ++j) {
                if (is_drop(j) || points.distance(i, j) > kSupport - kEdge) continue;
                wrong += times[{i, j}] != 1 || times[{j, i}] != 1;
            }
        }
        CHECK(wrong == 0);
    }
    CHECK(met > 0);
}

TEST_CASE("PairList.WallsSeeTheFluidThatComesBackIntoReach") {
    // As above, with a wall instead of the second body: what the fluid's lists get back, the walls' must, too.
    const int dimensions = GENERATE(2, 3);
    Points fluid, walls;
    fluid.dimensions = walls.dimensions = dimensions;
    for (int k = 0; k < 150; ++k) {
        const double x = k % 5, y = k / 5 % 5, z = dimensions == 3 ? k / 25 : 0.05 * (k / 25);
        fluid.add({x, y, z});
        walls.add({x + 7.2, y, z});  // 3.2 between them
    }
    // At rest, in other blocks: most stay pruned, so that nothing is pruned anew.
    fluid.fill(4000, {-40, 20, 20}, {-10, 60, 25}, 31);
    fluid.sort();
    walls.sort();
    PairNeighboursOf<float> neighbours;
    neighbours.find(input_of(fluid, &walls));
    for (std::size_t i = 0; i < fluid.size(); ++i) fluid.x[0][i] += fluid.x[1][i] < 10.0 ? 0.28 : 0.0;
    REQUIRE(neighbours.move_fluid(fluid.x, fluid.V.data()));
    const auto there = listed_pairs(neighbours.fluid_to_wall(), neighbours.fluid(), neighbours.walls());
    const auto back = listed_pairs(neighbours.wall_to_fluid(), neighbours.walls(), neighbours.fluid());
    std::size_t expected = 0;
    for (std::size_t i = 0; i < fluid.size(); ++i) {
        for (std::size_t w = 0; w < walls.size(); ++w) {
            double r2 = 0.0;
            for (int k = 0; k < dimensions; ++k) r2 += std::pow(fluid.x[k][i] - walls.x[k][w], 2);
            expected += r2 < kSupport * kSupport;
        }
    }
    CHECK(expected > 0);
    CHECK(there.size() == expected);
    CHECK(back.size() == expected);
}

TEST_CASE("PairList.TellsWhenOneFastPointCouldCloseIn") {
    Points points;
    points.dimensions = 2;
    points.fill(200, {0, 0, 0}, {10, 10, 0}, 19);
    points.add({16.0, 5.0, 0.0});  // out of reach
    points.sort();
    PairNeighboursOf<float> neighbours;
    neighbours.find(input_of(points));
    const auto fast =
        static_cast<std::size_t>(std::find(points.id.begin(), points.id.end(), Index{200}) - points.id.begin());
    for (int step = 0; step < 100; ++step) {
        points.x[0][fast] -= 0.1;
        if (!neighbours.move_fluid(points.x, points.V.data())) break;
        check_complete(neighbours, points);
    }
    CHECK(points.x[0][fast] > 10.0);
    CHECK(points.x[0][fast] < 16.0);
}

TEST_CASE("PairList.WallsSeeTheFluidThatSeesThem") {
    const int dimensions = GENERATE(2, 3);
    const std::string kind = GENERATE("body", "periods");
    const Points fluid = make_body(kind, dimensions);
    Points walls;
    walls.dimensions = dimensions;
    walls.domain = fluid.domain;
    walls.fill(300, {0, 7, 0}, {11, 10, 9.5}, 23);
    walls.sort();
    PairNeighboursOf<float> neighbours;
    neighbours.find(input_of(fluid, &walls));
    const auto there = listed_pairs(neighbours.fluid_to_wall(), neighbours.fluid(), neighbours.walls());
    const auto back = listed_pairs(neighbours.wall_to_fluid(), neighbours.walls(), neighbours.fluid());
    CHECK(there.size() == back.size());
    std::size_t different = 0;
    for (const auto& [pair, count] : there) different += back.find({pair.second, pair.first})->second != count;
    CHECK(different == 0);
    // And all of them.
    std::size_t expected = 0;
    for (std::size_t i = 0; i < fluid.size(); ++i) {
        for (std::size_t w = 0; w < walls.size(); ++w) {
            double r2 = 0.0;
            for (int k = 0; k < dimensions; ++k) {
                double d = fluid.x[k][i] - walls.x[k][w];
                if (fluid.domain.periodic[k]) d -= fluid.period()[k] * std::round(d / fluid.period()[k]);
                r2 += d * d;
            }
            expected += r2 < kSupport * kSupport;
        }
    }
    CHECK(there.size() == expected);
}
