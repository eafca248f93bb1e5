#include "server/solver/neighbours.h"

#include <algorithm>

#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

// A cell is a trifle wider than the support radius, so that rounding of x / side never puts a neighbour two cells
// away: covers |x| up to 1e9 cells (rounding 1e9 * 2^-52 = 2e-7).
constexpr double kCellMargin = 1e-6;

// Beyond this cell, and for positions that are not numbers, particles share the outermost cell: a faulted state may
// be looked at without harm.
constexpr double kOutermost = 1e15;

std::int64_t cell_coordinate(double x, double inv_side) {
    const double cell = x * inv_side;
    if (!(cell > -kOutermost)) return static_cast<std::int64_t>(-kOutermost);
    const auto truncated = static_cast<std::int64_t>(std::min(cell, kOutermost));
    return truncated - (cell < static_cast<double>(truncated));  // floor, without a call
}

}  // namespace

void CellGrid::sort(Particles& particles, double support) {
    dimensions_ = particles.dimensions;
    inv_side_ = 1.0 / (support * (1.0 + kCellMargin));
    order_.resize(particles.size());
    measure(particles);
    choose_layout(particles.size());
    if (is_dense_) {
        order_dense(particles);
    } else {
        order_sparse(particles);
    }
    permute(particles);
}

CellGrid::Coordinates CellGrid::coordinates(const Particles& particles, std::size_t i) const {
    Coordinates cell{};
    for (int axis = 0; axis < dimensions_; ++axis) cell[2 - axis] = cell_coordinate(particles.x[axis][i], inv_side_);
    return cell;
}

// The box of cells the particles occupy.
void CellGrid::measure(const Particles& particles) {
    struct Range {
        Coordinates lowest, highest;
    };
    const Range none{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
    const auto join = [](Range a, const Range& b) {
        for (int k = 0; k < 3; ++k) {
            a.lowest[k] = std::min(a.lowest[k], b.lowest[k]);
            a.highest[k] = std::max(a.highest[k], b.highest[k]);
        }
        return a;
    };
    const Range range = parallel_reduce(
        particles.size(), none,
        [&](std::size_t begin, std::size_t end) {
            Range block = none;
            for (std::size_t i = begin; i < end; ++i) {
                const Coordinates cell = coordinates(particles, i);
                block = join(block, {cell, cell});
            }
            return block;
        },
        join);
    lowest_ = particles.size() > 0 ? range.lowest : Coordinates{};
    highest_ = particles.size() > 0 ? range.highest : Coordinates{};
}

// Products in floating point, since they may exceed any integer.
void CellGrid::choose_layout(std::size_t count) {
    std::array<double, 3> width{};
    for (int k = 0; k < 3; ++k) width[k] = static_cast<double>(highest_[k] - lowest_[k]) + 3.0;
    if (dimensions_ == 2) width[0] = 1.0;
    const std::size_t allowed = std::max(kDenseMinimum, kDenseCells * count);
    is_dense_ = width[0] * width[1] * width[2] <= static_cast<double>(allowed);
    if (!is_dense_) return;
    row_ = static_cast<std::size_t>(width[2]);
    layer_ = row_ * static_cast<std::size_t>(width[1]);
    start_.assign(layer_ * static_cast<std::size_t>(width[0]) + 1, 0);
}

// Counting sort. Ranks within a cell are handed out in any order, then ids decide.
void CellGrid::order_dense(const Particles& particles) {
    const std::size_t count = particles.size();
    number_.resize(count);
    rank_.resize(count);
    const std::int64_t border_z = dimensions_ == 3 ? 1 : 0;
    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const Coordinates cell = coordinates(particles, i);
            const std::size_t number = layer_ * static_cast<std::size_t>(cell[0] - lowest_[0] + border_z) +
                                       row_ * static_cast<std::size_t>(cell[1] - lowest_[1] + 1) +
                                       static_cast<std::size_t>(cell[2] - lowest_[2] + 1);
            number_[i] = static_cast<Index>(number);
            Index rank;
#pragma omp atomic capture
            rank = start_[number]++;
            rank_[i] = rank;
        }
    });

    // Counts become starts; occupied cells are noted on the way.
    first_.clear();
    cell_number_.clear();
    Index sum = 0;
    for (std::size_t cell = 0; cell < start_.size(); ++cell) {
        const Index in_cell = start_[cell];
        start_[cell] = sum;
        if (in_cell == 0) continue;
        first_.push_back(sum);
        cell_number_.push_back(static_cast<Index>(cell));
        sum += in_cell;
    }
    first_.push_back(sum);

    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) order_[start_[number_[i]] + rank_[i]] = static_cast<Index>(i);
    });
    parallel_for(cells(), kParticleBlock / 4, [&](std::size_t begin, std::size_t end, int) {
        const auto by_id = [&](Index a, Index b) { return particles.id[a] < particles.id[b]; };
        for (std::size_t c = begin; c < end; ++c) {
            const auto from = order_.begin() + first_[c], to = order_.begin() + first_[c + 1];
            if (!std::is_sorted(from, to, by_id)) std::sort(from, to, by_id);
        }
    });
}

void CellGrid::order_sparse(const Particles& particles) {
    const std::size_t count = particles.size();
    std::vector<Coordinates> cell_of(count);
    for (std::size_t i = 0; i < count; ++i) {
        cell_of[i] = coordinates(particles, i);
        order_[i] = static_cast<Index>(i);
    }
    std::sort(order_.begin(), order_.end(), [&](Index a, Index b) {
        return cell_of[a] != cell_of[b] ? cell_of[a] < cell_of[b] : particles.id[a] < particles.id[b];
    });
    first_.clear();
    cell_coordinates_.clear();
    for (std::size_t slot = 0; slot < count; ++slot) {
        const Coordinates& cell = cell_of[order_[slot]];
        if (!cell_coordinates_.empty() && cell_coordinates_.back() == cell) continue;
        cell_coordinates_.push_back(cell);
        first_.push_back(static_cast<Index>(slot));
    }
    first_.push_back(static_cast<Index>(count));
}

void CellGrid::permute(Particles& particles) {
    const std::size_t count = order_.size();
    const std::array<VectorField*, 3> fields{&particles.x, &particles.v_half, &particles.v};
    scratch_id_.resize(count);
    for (VectorField& scratch : scratch_) {
        for (int axis = 0; axis < dimensions_; ++axis) scratch[axis].resize(count);
    }
    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) scratch_id_[i] = particles.id[order_[i]];
        for (std::size_t f = 0; f < fields.size(); ++f) {
            for (int axis = 0; axis < dimensions_; ++axis) {
                const double* from = (*fields[f])[axis].data();
                double* to = scratch_[f][axis].data();
                for (std::size_t i = begin; i < end; ++i) to[i] = from[order_[i]];
            }
        }
    });
    particles.id.swap(scratch_id_);
    for (std::size_t f = 0; f < fields.size(); ++f) {
        for (int axis = 0; axis < dimensions_; ++axis) (*fields[f])[axis].swap(scratch_[f][axis]);
    }
}

Neighbourhood CellGrid::around_dense(std::size_t c) const {
    Neighbourhood near;
    const std::size_t here = cell_number_[c];
    const int layers = dimensions_ == 3 ? 1 : 0;
    for (int dz = -layers; dz <= layers; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            const std::size_t middle = here + dz * layer_ + dy * row_;
            const Run run{start_[middle - 1], start_[middle + 2]};
            if (run.begin == run.end) continue;
            near.run[near.runs++] = run;
            near.particles += run.end - run.begin;
        }
    }
    return near;
}

Neighbourhood CellGrid::around_sparse(std::size_t c) const {
    Neighbourhood near;
    const Coordinates here = cell_coordinates_[c];
    const int layers = dimensions_ == 3 ? 1 : 0;
    const auto first_not_before = [&](const Coordinates& cell) {
        const auto found = std::lower_bound(cell_coordinates_.begin(), cell_coordinates_.end(), cell);
        return first_[static_cast<std::size_t>(found - cell_coordinates_.begin())];
    };
    for (int dz = -layers; dz <= layers; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            const Run run{first_not_before({here[0] + dz, here[1] + dy, here[2] - 1}),
                          first_not_before({here[0] + dz, here[1] + dy, here[2] + 2})};
            if (run.begin == run.end) continue;
            near.run[near.runs++] = run;
            near.particles += run.end - run.begin;
        }
    }
    return near;
}

}  // namespace headrace::solver
