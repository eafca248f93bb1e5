#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "fixtures.h"
#include "server/solver/parallel.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

double distance2(const Particles& particles, std::size_t i, std::size_t j) {
    double sum = 0.0;
    for (int k = 0; k < particles.dimensions; ++k) {
        sum += (particles.x[k][i] - particles.x[k][j]) * (particles.x[k][i] - particles.x[k][j]);
    }
    return sum;
}

// Every pair within the support is among the candidates exactly once, every particle in exactly one cell.
void check_against_all_pairs(Particles particles, double support) {
    CellGrid grid;
    grid.sort(particles, support);
    std::set<std::pair<std::size_t, std::size_t>> found;
    std::vector<int> visits(particles.size(), 0);
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        const Run cell = grid.cell(c);
        REQUIRE(cell.begin < cell.end);
        for (Index i = cell.begin; i < cell.end; ++i) {
            ++visits[i];
            for_each_candidate(grid, c, [&](Index j) {
                if (distance2(particles, i, j) > support * support) return;
                const bool is_new = found.insert({i, j}).second;
                CHECK(is_new);
            });
        }
    }
    CHECK(std::all_of(visits.begin(), visits.end(), [](int count) { return count == 1; }));
    std::size_t expected = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (std::size_t j = 0; j < particles.size(); ++j) expected += distance2(particles, i, j) <= support * support;
    }
    CHECK(found.size() == expected);
}

std::vector<Vec3> clusters(unsigned seed, int dimensions) {
    std::vector<Vec3> points;
    for (unsigned blob = 0; blob < 4; ++blob) {
        const Vec3 centre = random_points(1, 10.0, seed + blob, dimensions)[0];
        for (Vec3 point : random_points(60, 0.3, 100 * seed + blob, dimensions)) {
            for (int k = 0; k < dimensions; ++k) point[k] += centre[k];
            points.push_back(point);
        }
    }
    return points;
}

}  // namespace

TEST_CASE("CellGrid.MatchesAllPairs") {
    for (const int dimensions : {2, 3}) {
        for (const unsigned seed : {1u, 2u, 3u}) {
            INFO("dimensions " << dimensions << ", seed " << seed);
            check_against_all_pairs(make_particles(dimensions, random_points(300, 1.0, seed, dimensions)), 0.17);
            check_against_all_pairs(make_particles(dimensions, clusters(seed, dimensions)), 0.1);
        }
    }
}

TEST_CASE("CellGrid.HandlesOneCellOneParticleAndNone") {
    check_against_all_pairs(make_particles(3, random_points(50, 0.01, 7)), 1.0);
    check_against_all_pairs(make_particles(3, {{0.3, -0.2, 0.1}}), 0.1);
    check_against_all_pairs(make_particles(3, {}), 0.1);
    check_against_all_pairs(make_particles(2, {}), 0.1);
    check_against_all_pairs(make_particles(3, {{0, 0, 0}, {0, 0, 0}, {0.1, 0, 0}}), 0.1);
}

TEST_CASE("CellGrid.IsSparseForDropsFarApart") {
    for (const int dimensions : {2, 3}) {
        std::vector<Vec3> points = random_points(200, 0.2, 5, dimensions);
        for (const Vec3& far : random_points(40, 1e6, 6, dimensions)) {
            points.push_back(far);
            points.push_back({far[0] + 0.004, far[1] - 0.003, far[2]});  // each with one companion
        }
        Particles particles = make_particles(dimensions, points);
        CellGrid grid;
        grid.sort(particles, 0.01);
        CHECK_FALSE(grid.is_dense());
        check_against_all_pairs(particles, 0.01);
    }
}

TEST_CASE("CellGrid.IsDenseForACompactFluidWhereverItIs") {
    Particles particles = make_particles(3, lattice({10, 10, 10}, 0.02, {5e5, -3e5, 9e5}));
    CellGrid grid;
    grid.sort(particles, 0.04);
    CHECK(grid.is_dense());
}

TEST_CASE("CellGrid.OrderIsAFunctionOfTheStateAlone") {
    const unsigned seed = 11;
    INFO("seed " << seed);
    Particles sorted = make_particles(3, random_points(2500, 0.5, seed));
    Particles shuffled = sorted;
    std::vector<Index> order(sorted.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
    std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
    for (std::size_t i = 0; i < order.size(); ++i) {
        shuffled.id[i] = sorted.id[order[i]];
        for (int k = 0; k < 3; ++k) shuffled.x[k][i] = sorted.x[k][order[i]];
    }
    CellGrid grid;
    grid.sort(sorted, 0.05);
    for (const int threads : {1, 3}) {
        Particles again = shuffled;
        const int before = max_threads();
        omp_set_num_threads(threads);
        grid.sort(again, 0.05);
        omp_set_num_threads(before);
        CHECK(again.id == sorted.id);
        CHECK(again.x == sorted.x);
    }
}

TEST_CASE("CellGrid.FieldsMoveTogether") {
    Particles particles = make_particles(3, random_points(500, 1.0, 13));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            particles.v[k][i] = particles.x[k][i] + 1.0;
            particles.v_half[k][i] = particles.x[k][i] + 2.0;
        }
    }
    const Particles original = particles;
    CellGrid grid;
    grid.sort(particles, 0.2);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            CHECK(particles.x[k][i] == original.x[k][particles.id[i]]);
            CHECK(particles.v[k][i] == particles.x[k][i] + 1.0);
            CHECK(particles.v_half[k][i] == particles.x[k][i] + 2.0);
        }
    }
}

TEST_CASE("CellGrid.SurvivesPositionsThatAreNotNumbers") {
    Particles particles = make_particles(3, random_points(20, 1.0, 17));
    particles.x[0][3] = std::nan("");
    particles.x[1][7] = std::numeric_limits<double>::infinity();
    particles.x[2][9] = -1e300;
    CellGrid grid;
    grid.sort(particles, 0.1);
    std::set<Index> ids(particles.id.begin(), particles.id.end());
    CHECK(ids.size() == 20);
}
