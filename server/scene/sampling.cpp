#include "server/scene/sampling.h"

#include <array>
#include <cmath>

#include "server/scene/shapes.h"

namespace headrace::scene {

namespace {

// Half a cell of slack: an extent of n spacings gives n cells in spite of rounding in the document.
std::array<std::int64_t, 3> cells_per_axis(const proto::BoxDesc& bounds, int dimensions, double spacing) {
    constexpr double kMost = 2e6;  // per axis: three axes multiply to less than 2^63
    std::array<std::int64_t, 3> cells{1, 1, 1};
    for (int k = 0; k < dimensions; ++k) {
        const double count = std::floor((bounds.max[k] - bounds.min[k]) / spacing + 0.5);
        cells[k] = static_cast<std::int64_t>(std::fmax(0.0, std::fmin(count, kMost)));
    }
    return cells;
}

}  // namespace

std::int64_t lattice_size(const proto::ShapeDesc& shape, int dimensions, double spacing) {
    const auto cells = cells_per_axis(bounding_box(shape), dimensions, spacing);
    return cells[0] * cells[1] * cells[2];
}

void for_each_lattice_point(const proto::ShapeDesc& shape, int dimensions, double spacing,
                            const std::function<bool(const proto::Vec3&)>& visit) {
    const proto::BoxDesc bounds = bounding_box(shape);
    const auto cells = cells_per_axis(bounds, dimensions, spacing);
    const bool fills_bounds = std::holds_alternative<proto::BoxDesc>(shape);
    const auto coordinate = [&](int axis, std::int64_t k) {
        return axis < dimensions ? bounds.min[axis] + (static_cast<double>(k) + 0.5) * spacing : 0.0;
    };
    for (std::int64_t kz = 0; kz < cells[2]; ++kz)
        for (std::int64_t ky = 0; ky < cells[1]; ++ky)
            for (std::int64_t kx = 0; kx < cells[0]; ++kx) {
                const proto::Vec3 x{coordinate(0, kx), coordinate(1, ky), coordinate(2, kz)};
                if ((fills_bounds || contains(shape, x, dimensions)) && !visit(x)) return;
            }
}

std::int64_t count_particles(const proto::FluidDesc& fluid, int dimensions, double spacing) {
    if (fluid.particles) return 0;
    if (std::holds_alternative<proto::BoxDesc>(fluid.shape)) return lattice_size(fluid.shape, dimensions, spacing);
    std::int64_t count = 0;
    for_each_lattice_point(fluid.shape, dimensions, spacing, [&](const proto::Vec3&) { return ++count, true; });
    return count;
}

std::int64_t count_particles(const proto::SceneDesc& scene, const FluidFiles& files) {
    std::int64_t count = 0;
    for (const proto::FluidDesc& fluid : scene.fluids) count += count_particles(fluid, scene.dimensions, scene.spacing);
    for (const auto& [fluid, set] : files) count += static_cast<std::int64_t>(set.x.size());
    return count;
}

}  // namespace headrace::scene
