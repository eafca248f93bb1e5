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
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/solver/particles.h"

namespace headrace::solver {

// Particles [begin, end) of the storage order.
struct Run {
    Index begin{};
    Index end{};
};

// The particles of the cells around a cell, itself included.
struct Neighbourhood {
    std::array<Run, 9> run;
    int runs{};
    std::size_t particles{};  // in all runs together
};

class CellGrid {
  public:
    // Sorts id, x, v_half and v; a, rho and p are left as they are, the step computes them anew.
    void sort(Particles& particles, double support);

    std::size_t cells() const { return first_.size() - 1; }  // occupied ones
    Run cell(std::size_t c) const { return {first_[c], first_[c + 1]}; }
    Neighbourhood around(std::size_t c) const { return is_dense_ ? around_dense(c) : around_sparse(c); }
    bool is_dense() const { return is_dense_; }

  private:
    using Coordinates = std::array<std::int64_t, 3>;  // z, y, x: compares lexicographically, x fastest

    static constexpr std::size_t kDenseCells = 8;        // per particle: 32 bytes a particle at most
    static constexpr std::size_t kDenseMinimum = 65536;  // small scenes may always have this many

    Neighbourhood around_dense(std::size_t c) const;
    Neighbourhood around_sparse(std::size_t c) const;
    Coordinates coordinates(const Particles& particles, std::size_t i) const;
    void measure(const Particles& particles);
    void choose_layout(std::size_t count);
    void order_dense(const Particles& particles);
    void order_sparse(const Particles& particles);
    void permute(Particles& particles);

    int dimensions_{3};
    double inv_side_{};  // [1/m]
    bool is_dense_{true};
    std::vector<Index> first_{0};  // [cells + 1] first particle of each occupied cell
    std::vector<Index> order_;     // [N] old slot of the particle that belongs into this slot

    Coordinates lowest_{}, highest_{};  // of the occupied cells

    // dense: cells of the bounding box with an empty border, so that no neighbour needs a bounds test
    std::size_t row_{}, layer_{};     // cells from one row to the next, from one layer to the next
    std::vector<Index> start_;        // [all cells + 1]
    std::vector<Index> cell_number_;  // [cells] of the occupied ones
    std::vector<Index> number_;       // [N] cell of each particle
    std::vector<Index> rank_;         // [N] place within its cell before ordering by id

    // sparse
    std::vector<Coordinates> cell_coordinates_;  // [cells]

    // the other half of each sorted array
    std::vector<Index> scratch_id_;
    std::array<VectorField, 3> scratch_;
};

// body(j) for each particle j of the cells around cell c: the plain gather, for tests and rare paths.
template <class Body>
void for_each_candidate(const CellGrid& grid, std::size_t c, Body&& body) {
    const Neighbourhood near = grid.around(c);
    for (int k = 0; k < near.runs; ++k) {
        for (Index j = near.run[k].begin; j < near.run[k].end; ++j) body(j);
    }
}

}  // namespace headrace::solver
