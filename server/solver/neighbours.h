// Who is near whom: particles sorted into cells of side >= the support radius (Staubach 2010, Alg. 3.2).
//
// Cells are numbered lexicographically, x fastest, so the three cells side by side along x are one run of particles
// in storage, and the 3^D cells around a particle are 3^(D-1) runs. Only occupied cells are visited.
//
// Within a cell particles stand in the order of their ids. The order in storage, and so every sum, is a function of
// the state alone: neither threads nor the order in which particles were handed in can change a bit.
//
// Two layouts, chosen by the extent of the fluid, not of the domain:
//   dense   one start index per cell of the particles' bounding box; the usual case
//   sparse  sorted list of occupied cells, found by bisection; where the box would take more than kDenseCells cells
//           per particle (a few drops far apart). Costs O(N log N) and no memory for empty space.
//
// Along a periodic axis the period is divided into whole cells, three at least; runs from the other end carry the
// number of periods their particles are to be displaced by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/solver/objects.h"
#include "server/solver/parallel.h"
#include "server/solver/particles.h"
#include "server/solver/space_division.h"

namespace headrace::solver {

// Particles [begin, end) of the storage order, displaced by image[axis] periods.
struct Run {
    Index begin{};
    Index end{};
    std::array<signed char, 3> image{};
};

// The particles of the cells around a cell, itself included.
struct Neighbourhood {
    std::array<Run, 18> run;  // 3^(D-1) rows, each in two pieces where it crosses a periodic end
    int runs{};
    std::size_t particles{};  // in all runs together
};

class CellGrid {
  public:
    using Coordinates = Bin;  // compares lexicographically, x fastest

    // Finds the order of the points: cells of side >= `support`. Along the domain's periodic axes x must lie inside
    // [min, max), and max - min must be at least three times the support (fits_period).
    void build(const VectorField& x, const std::vector<Index>& id, int dimensions, double support,
               const Domain* domain = nullptr);

    // Puts one array of the points into the order found by build().
    template <class T>
    void permute(std::vector<T>& values, std::vector<T>& scratch) const;

    // build() and permute() for id, x, v_half and v; a, rho and p are left as they are, the step computes them anew.
    void sort(Particles& particles, double support);

    std::size_t cells() const { return first_.size() - 1; }  // occupied ones
    Run cell(std::size_t c) const { return {first_[c], first_[c + 1], {}}; }
    const Coordinates& coordinates(std::size_t c) const { return cell_coordinates_[c]; }
    Neighbourhood around(std::size_t c) const { return around(cell_coordinates_[c]); }
    // Of any cell of the same division of space, occupied or not.
    Neighbourhood around(const Coordinates& here) const;
    bool is_dense() const { return is_dense_; }

  private:
    static constexpr std::size_t kDenseCells = 8;        // per particle: 32 bytes a particle at most
    static constexpr std::size_t kDenseMinimum = 65536;  // small scenes may always have this many

    Run find_run(std::int64_t z, std::int64_t y, std::int64_t x_first, std::int64_t x_last) const;
    void divide(int dimensions, double support, const Domain* domain);
    void choose_layout(std::size_t count);
    void order_dense(const VectorField& x, const std::vector<Index>& id);
    void order_sparse(const VectorField& x, const std::vector<Index>& id);

    SpaceDivision division_;
    BinRange range_;  // of the occupied cells
    bool is_dense_{true};
    std::vector<Index> first_{0};                // [cells + 1] first particle of each occupied cell
    std::vector<Coordinates> cell_coordinates_;  // [cells]
    std::vector<Index> order_;                   // [N] old slot of the particle that belongs into this slot

    // dense: all cells of the bounding box
    std::size_t row_{}, layer_{};  // cells from one row to the next, from one layer to the next
    std::vector<Index> start_;     // [all cells + 1]
    std::vector<Index> number_;    // [N] cell of each particle
    std::vector<Index> rank_;      // [N] place within its cell before ordering by id

    std::vector<Index> scratch_id_;
    std::vector<double> scratch_;
};

// Is the period long enough for cells of this support?
inline bool fits_period(double length, double support) {
    return length >= 3.0 * support * (1.0 + 1e-5);
}

template <class T>
void CellGrid::permute(std::vector<T>& values, std::vector<T>& scratch) const {
    scratch.resize(order_.size());
    parallel_for(order_.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) scratch[i] = values[order_[i]];
    });
    values.swap(scratch);
}

// body(j) for each particle j of the cells around cell c: the plain gather, for tests and rare paths.
template <class Body>
void for_each_candidate(const CellGrid& grid, std::size_t c, Body&& body) {
    const Neighbourhood near = grid.around(c);
    for (int k = 0; k < near.runs; ++k) {
        for (Index j = near.run[k].begin; j < near.run[k].end; ++j) body(j);
    }
}

}  // namespace headrace::solver
