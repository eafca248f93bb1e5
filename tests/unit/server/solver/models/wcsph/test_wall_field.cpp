// No fluid stays in a solid.
#include <catch2/catch.hpp>

#include "scenes.h"
#include "server/solver/models/wcsph/wall_field.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

std::unique_ptr<PairNeighbours> find_neighbours(Scene& scene, const WallField& walls, double support) {
    Particles& particles = scene.particles;
    ClusterOrder order;
    std::vector<double> scratch;
    std::vector<Index> scratch_id;
    order.build(particles.x, particles.id, scene.dimensions, scene.dx, scene.domain);
    order.permute(particles.id, scratch_id);
    for (VectorField* field : {&particles.x, &particles.v}) {
        for (int k = 0; k < scene.dimensions; ++k) order.permute((*field)[k], scratch);
    }
    const std::vector<double> V(particles.size(), 1.0);
    auto neighbours = make_pair_neighbours(Arithmetic::single_precision);
    neighbours->find({scene.dimensions, {&order, &particles.x, V.data(), V.size()}, walls.points(), {support}});
    return neighbours;
}

}  // namespace

TEST_CASE("WallField.FluidInSolidsThatTouchIsPutBackIntoTheRoom") {
    // A block on a tank's floor, one in its corner and one across it: the nearest surface of what is low in a block is
    // its bottom, where the floor begins.
    const int dimensions = GENERATE(2, 3);
    Scene scene;
    scene.dimensions = dimensions;
    const double dx = scene.dx;
    scene.objects = {{"tank", Role::container, Box{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}},
                     {"block", Role::obstacle, Box{{0.5, 0.1, 0.5}, {0.1, 0.1, 0.1}}},
                     {"step", Role::obstacle, Box{{0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}}},
                     {"beam", Role::obstacle, Box{{0.5, 0.7, 0.5}, {0.5, 0.1, 0.1}}}};
    const int across = static_cast<int>(std::lround(1.2 / (0.6 * dx)));
    scene.particles = make_particles(dimensions, lattice({across, across, dimensions == 3 ? across : 1}, 0.6 * dx,
                                                         {-0.1, -0.1, dimensions == 3 ? -0.1 : 0.5 - 0.2 * dx}));
    for (int k = 0; k < dimensions; ++k) std::fill(scene.particles.v[k].begin(), scene.particles.v[k].end(), -1.0);
    const double support = 3.0 * dx;
    WallField walls(dimensions, dx, support);
    walls.place(scene.surroundings(), 0.0, true, {});
    walls.put_in_order(scene.domain);
    const auto neighbours = find_neighbours(scene, walls, support);

    CHECK(walls.hold(scene.particles, *neighbours, 1e-3) > 0);

    double deepest = 0.0;
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        deepest = std::min(deepest, walls.walls().distance_to_any(at(scene.particles.x, dimensions, i)));
    CHECK(deepest == 0.0);
    CHECK(walls.hold(scene.particles, *neighbours, 1e-3) == 0);
}
