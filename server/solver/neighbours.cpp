#include "server/solver/neighbours.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "server/solver/parallel.h"
namespace headrace::solver {
namespace {

// A cell is a trifle wider than the support radius, so that rounding of x / side never puts a neighbour two cells
// away: covers |x| up to 1e9 cells (rounding 1e9 * 2^-52 = 2e-7).
constexpr double kCellMargin = 1e-6;

}  // namespace

void CellGrid::build(const VectorField& x, const std::vector<Index>& id, int dimensions, double support,
                     const Domain* domain) {
    divide(dimensions, support, domain);
    order_.resize(id.size());
    range_ = division_.range_of(x, id.size());
    choose_layout(id.size());
    if (is_dense_) {
        order_dense(x, id);
    } else {
        order_sparse(x, id);
    }
}

void CellGrid::sort(Particles& particles, double support) {
    build(particles.x, particles.id, particles.dimensions, support);
    permute(particles.id, scratch_id_);
    for (VectorField* field : {&particles.x, &particles.v_half, &particles.v}) {
        for (int axis = 0; axis < particles.dimensions; ++axis) permute((*field)[axis], scratch_);
    }
}

// Cells of side >= support; along a periodic axis as many as fit.
void CellGrid::divide(int dimensions, double support, const Domain* domain) {
    const double side = support * (1.0 + kCellMargin);
    const Domain open;
    if (domain == nullptr) domain = &open;
    for (int axis = 0; axis < dimensions; ++axis)
        assert(!domain->periodic[axis] || fits_period(domain->max[axis] - domain->min[axis], support));
    division_.divide(dimensions, {side, side, side}, *domain);
}

void CellGrid::choose_layout(std::size_t count) {
    is_dense_ = range_.bins() <= static_cast<double>(std::max(kDenseMinimum, kDenseCells * count));
    if (!is_dense_) return;
    row_ = static_cast<std::size_t>(range_.width(2));
    layer_ = row_ * static_cast<std::size_t>(range_.width(1));
    start_.assign(layer_ * static_cast<std::size_t>(range_.width(0)) + 1, 0);
}

// Counting sort. Ranks within a cell are handed out in any order, then ids decide.
void CellGrid::order_dense(const VectorField& x, const std::vector<Index>& id) {
    const std::size_t count = id.size();
    number_.resize(count);
    rank_.resize(count);
    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const Coordinates cell = division_.find(x, i);
            const std::size_t number = layer_ * static_cast<std::size_t>(cell[0] - range_.lowest[0]) +
                                       row_ * static_cast<std::size_t>(cell[1] - range_.lowest[1]) +
                                       static_cast<std::size_t>(cell[2] - range_.lowest[2]);
            number_[i] = static_cast<Index>(number);
            Index rank;
#pragma omp atomic capture
            rank = start_[number]++;
            rank_[i] = rank;
        }
    });

    // Counts become starts; occupied cells are noted on the way.
    first_.clear();
    cell_coordinates_.clear();
    Index sum = 0;
    for (std::size_t cell = 0; cell < start_.size(); ++cell) {
        const Index in_cell = start_[cell];
        start_[cell] = sum;
        if (in_cell == 0) continue;
        first_.push_back(sum);
        cell_coordinates_.push_back({range_.lowest[0] + static_cast<std::int64_t>(cell / layer_),
                                     range_.lowest[1] + static_cast<std::int64_t>(cell % layer_ / row_),
                                     range_.lowest[2] + static_cast<std::int64_t>(cell % row_)});
        sum += in_cell;
    }
    first_.push_back(sum);

    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) order_[start_[number_[i]] + rank_[i]] = static_cast<Index>(i);
    });
    parallel_for(cells(), kParticleBlock / 4, [&](std::size_t begin, std::size_t end, int) {
        const auto by_id = [&](Index a, Index b) { return id[a] < id[b]; };
        for (std::size_t c = begin; c < end; ++c) {
            const auto from = order_.begin() + first_[c], to = order_.begin() + first_[c + 1];
            if (!std::is_sorted(from, to, by_id)) std::sort(from, to, by_id);
        }
    });
}

void CellGrid::order_sparse(const VectorField& x, const std::vector<Index>& id) {
    const std::size_t count = id.size();
    std::vector<Coordinates> cell_of(count);
    for (std::size_t i = 0; i < count; ++i) {
        cell_of[i] = division_.find(x, i);
        order_[i] = static_cast<Index>(i);
    }
    std::sort(order_.begin(), order_.end(),
              [&](Index a, Index b) { return cell_of[a] != cell_of[b] ? cell_of[a] < cell_of[b] : id[a] < id[b]; });
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

// Particles of the cells x_first..x_last of a row: one run, since x is fastest.
Run CellGrid::find_run(std::int64_t z, std::int64_t y, std::int64_t x_first, std::int64_t x_last) const {
    if (z < range_.lowest[0] || z > range_.highest[0] || y < range_.lowest[1] || y > range_.highest[1]) return {};
    x_first = std::max(x_first, range_.lowest[2]);
    x_last = std::min(x_last, range_.highest[2]);
    if (x_first > x_last) return {};
    if (is_dense_) {
        const std::size_t row = layer_ * static_cast<std::size_t>(z - range_.lowest[0]) +
                                row_ * static_cast<std::size_t>(y - range_.lowest[1]);
        return {start_[row + static_cast<std::size_t>(x_first - range_.lowest[2])],
                start_[row + static_cast<std::size_t>(x_last - range_.lowest[2]) + 1],
                {}};
    }
    const auto first_not_before = [&](const Coordinates& cell) {
        const auto found = std::lower_bound(cell_coordinates_.begin(), cell_coordinates_.end(), cell);
        return first_[static_cast<std::size_t>(found - cell_coordinates_.begin())];
    };
    return {first_not_before({z, y, x_first}), first_not_before({z, y, x_last + 1}), {}};
}

Neighbourhood CellGrid::around(const Coordinates& here) const {
    Neighbourhood near;
    if (cells() == 0) return near;
    // The coordinate inside the period, and by how many periods the particles there are to be displaced.
    const auto wrap = [&](int axis, std::int64_t& c) -> signed char {
        if (division_.bins_in_period(axis) == 0) return 0;
        if (c < 0) return c += division_.bins_in_period(axis), static_cast<signed char>(-1);
        if (c >= division_.bins_in_period(axis))
            return c -= division_.bins_in_period(axis), static_cast<signed char>(1);
        return 0;
    };
    const auto add = [&](Run run, const std::array<signed char, 3>& image) {
        if (run.begin == run.end) return;
        run.image = image;
        near.run[near.runs++] = run;
        near.particles += run.end - run.begin;
    };
    const int layers = division_.dimensions() == 3 ? 1 : 0;
    for (int dz = -layers; dz <= layers; ++dz) {
        std::int64_t z = here[0] + dz;
        const signed char image_z = wrap(2, z);
        for (int dy = -1; dy <= 1; ++dy) {
            std::int64_t y = here[1] + dy;
            const signed char image_y = wrap(1, y);
            const std::int64_t x = here[2], n = division_.bins_in_period(0);
            if (n > 0 && x == 0) add(find_run(z, y, n - 1, n - 1), {-1, image_y, image_z});
            const std::int64_t x_first = n > 0 ? std::max<std::int64_t>(x - 1, 0) : x - 1;
            const std::int64_t x_last = n > 0 ? std::min(x + 1, n - 1) : x + 1;
            add(find_run(z, y, x_first, x_last), {0, image_y, image_z});
            if (n > 0 && x == n - 1) add(find_run(z, y, 0, 0), {1, image_y, image_z});
        }
    }
    return near;
}

}  // namespace headrace::solver
