#include "tests/bench/neighbour_count.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace headrace::bench {

namespace {

constexpr std::size_t kSample = 20000;

// Own linked cells: the figure must not depend on the solver's neighbour search.
class Cells {
  public:
    Cells(const solver::Particles& particles, double support)
        : particles_(particles), dimensions_(particles.dimensions) {
        double volume = 1.0;
        std::array<double, 3> extent{};
        for (int axis = 0; axis < dimensions_; ++axis) {
            const auto [low, high] = std::minmax_element(particles.x[axis].begin(), particles.x[axis].end());
            origin_[axis] = *low;
            extent[axis] = *high - *low + support;
            volume *= extent[axis];
        }
        // Never more than some four cells a particle, however thin the spray.
        const double most_cells = 4.0 * static_cast<double>(particles.size()) + 1000.0;
        side_ = std::max(support, std::pow(volume / most_cells, 1.0 / dimensions_));
        for (int axis = 0; axis < dimensions_; ++axis) counts_[axis] = static_cast<long>(extent[axis] / side_) + 1;

        first_.assign(static_cast<std::size_t>(counts_[0] * counts_[1] * counts_[2]) + 1, 0);
        for (std::size_t i = 0; i < particles.size(); ++i) ++first_[index_of(cell_of(i)) + 1];
        for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
        members_.resize(particles.size());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t i = 0; i < particles.size(); ++i) members_[next[index_of(cell_of(i))]++] = i;
    }

    std::size_t count_within(std::size_t i, double support) const {
        const std::array<long, 3> center = cell_of(i);
        std::array<long, 3> low{}, high{};
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::max(0L, center[axis] - 1);
            high[axis] = std::min(counts_[axis] - 1, center[axis] + 1);
        }
        std::size_t count = 0;
        for (long z = low[2]; z <= high[2]; ++z)
            for (long y = low[1]; y <= high[1]; ++y)
                for (long x = low[0]; x <= high[0]; ++x) count += count_in_cell(index_of({x, y, z}), i, support);
        return count;
    }

  private:
    std::array<long, 3> cell_of(std::size_t i) const {
        std::array<long, 3> cell{};
        for (int axis = 0; axis < dimensions_; ++axis)
            cell[axis] = static_cast<long>((particles_.x[axis][i] - origin_[axis]) / side_);
        return cell;
    }

    std::size_t index_of(const std::array<long, 3>& cell) const {
        return static_cast<std::size_t>((cell[2] * counts_[1] + cell[1]) * counts_[0] + cell[0]);
    }

    std::size_t count_in_cell(std::size_t cell, std::size_t i, double support) const {
        std::size_t count = 0;
        for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k) {
            const std::size_t j = members_[k];
            double distance2 = 0.0;
            for (int axis = 0; axis < dimensions_; ++axis) {
                const double d = particles_.x[axis][i] - particles_.x[axis][j];
                distance2 += d * d;
            }
            count += j != i && distance2 < support * support;
        }
        return count;
    }

    const solver::Particles& particles_;
    int dimensions_;
    std::array<double, 3> origin_{};
    double side_{};
    std::array<long, 3> counts_{1, 1, 1};
    std::vector<std::size_t> first_;    // of each cell, in members_
    std::vector<std::size_t> members_;  // particle slots, cell by cell
};

}  // namespace

double compute_mean_neighbours(const solver::Particles& particles, double support) {
    if (support <= 0.0 || particles.size() == 0) return 0.0;
    const Cells cells(particles, support);
    const std::size_t stride = std::max<std::size_t>(1, particles.size() / kSample);
    std::size_t sampled = 0, found = 0;
    for (std::size_t i = 0; i < particles.size(); i += stride, ++sampled) found += cells.count_within(i, support);
    return static_cast<double>(found) / static_cast<double>(sampled);
}

}  // namespace headrace::bench
