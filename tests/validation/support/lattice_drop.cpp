#include "tests/validation/support/lattice_drop.h"

#include <cmath>
#include <numbers>

namespace headrace::validation {

void fit_drop(proto::SceneDesc& scene, double radius, double resolution) {
    // Whole or half spacings a radius keep the lattice symmetric about the centre.
    const double n = std::round(2 * resolution) / 2;
    const int across = static_cast<int>(2 * n);
    int count = 0;
    for (int row = 0; row < across; ++row)
        for (int column = 0; column < across; ++column)
            if (std::hypot(row + 0.5 - n, column + 0.5 - n) <= n) ++count;
    scene.spacing = radius * std::sqrt(std::numbers::pi / count);
    std::get<proto::SphereDesc>(scene.fluids.front().shape).radius = n * scene.spacing;
}

}  // namespace headrace::validation
