// Periodic axes and two sets of points: against all pairs.
#include <catch2/catch.hpp>
#include <map>

#include "fixtures.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

// The domain: 3.2 to 5 cells along x, y, z.
constexpr double kSupport = 0.2;
constexpr std::array<double, 3> kLength{0.64, 1.0, 0.75};

Domain make_domain(int combination, double scale = 1.0) {
    Domain domain{{-0.1, 0.3, 5.0}, {}};
    for (int k = 0; k < 3; ++k) {
        domain.max[k] = domain.min[k] + scale * kLength[k];
        domain.periodic[k] = (combination >> k & 1) != 0;
    }
    return domain;
}

Particles points_in(const Domain& domain, int dimensions, int count, unsigned seed) {
    std::mt19937_64 random(seed);
    std::vector<Vec3> points(count);
    for (Vec3& x : points) {
        for (int k = 0; k < dimensions; ++k)
            x[k] = std::uniform_real_distribution<double>(domain.min[k], domain.max[k])(random);
    }
    return make_particles(dimensions, points);
}

using Key = std::array<int, 5>;  // i, j, image along each axis

void put(std::map<Key, int>& found, std::size_t i, std::size_t j, const std::array<int, 3>& image) {
    ++found[{static_cast<int>(i), static_cast<int>(j), image[0], image[1], image[2]}];
}

double distance2(const Particles& from, std::size_t i, const Particles& to, std::size_t j, const Domain& domain,
                 const std::array<int, 3>& image) {
    double sum = 0.0;
    for (int k = 0; k < from.dimensions; ++k) {
        const double d = from.x[k][i] - to.x[k][j] - image[k] * (domain.max[k] - domain.min[k]);
        sum += d * d;
    }
    return sum;
}

// Which j, at which images, lie within the support of which i.
std::map<Key, int> all_pairs(const Particles& from, const Particles& to, const Domain& domain) {
    std::map<Key, int> found;
    std::array<int, 3> reach{};
    for (int k = 0; k < from.dimensions; ++k) reach[k] = domain.periodic[k] ? 1 : 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        for (std::size_t j = 0; j < to.size(); ++j) {
            for (int z = -reach[2]; z <= reach[2]; ++z) {
                for (int y = -reach[1]; y <= reach[1]; ++y) {
                    for (int x = -reach[0]; x <= reach[0]; ++x) {
                        if (distance2(from, i, to, j, domain, {x, y, z}) < kSupport * kSupport)
                            put(found, i, j, {x, y, z});
                    }
                }
            }
        }
    }
    return found;
}

std::map<Key, int> by_grid(const Particles& from, const CellGrid& from_grid, const Particles& to,
                           const CellGrid& to_grid, const Domain& domain) {
    std::map<Key, int> found;
    for (std::size_t c = 0; c < from_grid.cells(); ++c) {
        const Neighbourhood near = to_grid.around(from_grid.coordinates(c));
        const Run cell = from_grid.cell(c);
        for (int r = 0; r < near.runs; ++r) {
            const std::array<int, 3> image{near.run[r].image[0], near.run[r].image[1], near.run[r].image[2]};
            for (Index j = near.run[r].begin; j < near.run[r].end; ++j) {
                for (Index i = cell.begin; i < cell.end; ++i) {
                    if (distance2(from, i, to, j, domain, image) < kSupport * kSupport) put(found, i, j, image);
                }
            }
        }
    }
    return found;
}

CellGrid sort_points(Particles& particles, const Domain& domain) {
    CellGrid grid;
    grid.build(particles.x, particles.id, particles.dimensions, kSupport, &domain);
    std::vector<double> scratch;
    std::vector<Index> scratch_id;
    grid.permute(particles.id, scratch_id);
    for (int k = 0; k < particles.dimensions; ++k) grid.permute(particles.x[k], scratch);
    return grid;
}

}  // namespace

TEST_CASE("CellGrid.FindsAllPairsThroughPeriodsOfOneSetAndOfTwo") {
    const int dimensions = GENERATE(2, 3);
    for (int combination = 0; combination < (dimensions == 2 ? 4 : 8); ++combination) {
        // 0.94: 3.008 cells along the shortest axis, just above the least
        for (const double scale : {1.0, 0.94}) {
            const unsigned seed = 17u + static_cast<unsigned>(combination);
            INFO(dimensions << "D, periodic axes " << combination << ", scale " << scale << ", seed " << seed);
            const Domain domain = make_domain(combination, scale);
            Particles fluid = points_in(domain, dimensions, 150, seed), walls = points_in(domain, dimensions, 60, 7);
            const CellGrid fluid_grid = sort_points(fluid, domain), wall_grid = sort_points(walls, domain);
            CHECK(by_grid(fluid, fluid_grid, fluid, fluid_grid, domain) == all_pairs(fluid, fluid, domain));
            CHECK(by_grid(fluid, fluid_grid, walls, wall_grid, domain) == all_pairs(fluid, walls, domain));
            CHECK(by_grid(walls, wall_grid, fluid, fluid_grid, domain) == all_pairs(walls, fluid, domain));
        }
    }
}

TEST_CASE("CellGrid.PeriodsHoldWhereTheGridIsSparse") {
    // Two clusters at the ends of a long period: too much empty space for the dense layout.
    Domain domain{{0, 0, 0}, {4e4, 1, 1}, {true, false, false}};
    std::vector<Vec3> points = random_points(100, 0.5, 3, 3);
    for (Vec3& x : points) {
        for (double& component : x) component += 0.5;
        if (x[0] < 0.5) x[0] += 4e4 - 0.5;
    }
    for (double at = 100.0; at < 4e4; at += 371.0) points.push_back({at, at * 1e-5, 0.3});
    Particles particles = make_particles(3, points);
    const CellGrid grid = sort_points(particles, domain);
    CHECK_FALSE(grid.is_dense());
    CHECK(by_grid(particles, grid, particles, grid, domain) == all_pairs(particles, particles, domain));
}

TEST_CASE("CellGrid.TellsWhichPeriodIsTooShort") {
    CHECK(fits_period(0.61, 0.2));
    CHECK_FALSE(fits_period(0.59, 0.2));
}
