#include "server/solver/models/wcsph/coincident.h"

#include <vector>

#include "server/solver/forces/separation.h"
#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

bool is_one_place(const Particles& particles, Index i, Index j, double distance) {
    double r2 = 0.0;
    for (int k = 0; k < particles.dimensions; ++k) {
        const double d = particles.x[k][i] - particles.x[k][j];
        r2 += d * d;
    }
    return r2 < distance * distance;
}

template <int D>
void move_apart(Particles& particles, Index i, Index j, double way, std::uint64_t step) {
    const std::array<double, D> e = separation_direction<D>(particles.id[i], particles.id[j], step);
    for (int k = 0; k < D; ++k) {
        particles.x[k][i] += way * e[k];
        particles.x[k][j] -= way * e[k];
    }
}

}  // namespace

std::uint64_t separate_coincident(Particles& particles, const CellGrid& grid, double spacing, std::uint64_t step) {
    constexpr std::size_t kCellBlock = 64;
    std::vector<std::uint64_t> counts((grid.cells() + kCellBlock - 1) / kCellBlock);
    parallel_for(grid.cells(), kCellBlock, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t c = first; c < last; ++c) {
            const Run cell = grid.cell(c);
            for (Index i = cell.begin; i < cell.end; ++i) {
                for (Index j = i + 1; j < cell.end; ++j) {
                    if (!is_one_place(particles, i, j, 1e-3 * spacing)) continue;
                    ++counts[first / kCellBlock];
                    if (particles.dimensions == 2)
                        move_apart<2>(particles, i, j, kCoincidentWay * spacing, step);
                    else
                        move_apart<3>(particles, i, j, kCoincidentWay * spacing, step);
                }
            }
        }
    });
    std::uint64_t count = 0;
    for (const std::uint64_t part : counts) count += part;
    return count;
}

}  // namespace headrace::solver
