#include "server/solver/models/wcsph/coincident.h"

#include <algorithm>
#include <utility>
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

std::uint64_t separate_coincident(Particles& particles, double spacing, std::uint64_t step) {
    constexpr std::size_t kLookAhead = 8;  // a crowd in one place thins out over the sorts to come
    const std::size_t count = particles.size();
    std::vector<std::vector<std::pair<Index, Index>>> found((count + kParticleBlock - 1) / kParticleBlock);
    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t j = i + 1; j < std::min(i + kLookAhead, count); ++j) {
                const auto one = static_cast<Index>(i), other = static_cast<Index>(j);
                if (is_one_place(particles, one, other, 1e-3 * spacing))
                    found[begin / kParticleBlock].emplace_back(one, other);
            }
        }
    });
    std::uint64_t pairs = 0;
    for (const auto& block : found) {
        for (const auto& [i, j] : block) {
            ++pairs;
            if (particles.dimensions == 2)
                move_apart<2>(particles, i, j, kCoincidentWay * spacing, step);
            else
                move_apart<3>(particles, i, j, kCoincidentWay * spacing, step);
        }
    }
    return pairs;
}

}  // namespace headrace::solver
