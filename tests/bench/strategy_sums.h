// The sums of the thesis model by the ways Staubach 2010 compares (sections 3.1 and 3.4), beside the model's own loop.
//
//   all_pairs        each particle with every other
//   linked_cells     each particle with those of the 3^D cells around it (section 3.1.1)
//   symmetry         half neighbourhood: each pair once, for both (section 3.1.2, Alg. 3.3)
//   coloured_layers  the same by layers of cells, in parallel (section 3.4)
//   simd             the model's own: whole neighbourhood, candidates copied side by side, SIMD lanes
//
// The first four are scalar loops over the very formulas of server/solver, with pairs out of reach skipped by a branch.
// Differs from Staubach 2010: cells are runs of sorted particles (neighbours.h), not linked lists of references, and
// layers are coloured. Alg. 3.6 shares the layers out as they come; with the half neighbourhood two threads then
// write the particles between two layers.
//
// Precondition of the four: no two particles at one place (separation.h), pressure in the mean form (2.22). All terms
// are summed, whether or not their coefficients are 0.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "server/solver/isa.h"
#include "server/solver/models/thesis_sums.h"

namespace headrace::bench {

enum class Strategy { all_pairs, linked_cells, symmetry, coloured_layers, simd };

std::string_view strategy_name(Strategy strategy);

// Do further threads share its pair sums?
constexpr bool is_parallel(Strategy strategy) {
    return strategy == Strategy::coloured_layers || strategy == Strategy::simd;
}

class StrategySums {
  public:
    virtual ~StrategySums() = default;
    // rho of all particles (2.17).
    virtual void compute_density(const solver::SumInput& in, double* rho) = 0;
    // a of all particles (2.16); rho, p and in.volume are those of the density.
    virtual void compute_acceleration(const solver::SumInput& in, const std::array<double*, 3>& a) = 0;
};

// `isa` is that of `simd`; the others are compiled for the baseline.
std::unique_ptr<StrategySums> make_strategy_sums(Strategy strategy, int dimensions, solver::Isa isa);

// Occupied cells [first, last).
struct CellRange {
    std::size_t first{}, last{};
};

// The occupied layers of cells along the slowest axis, even ones and odd ones. The half neighbourhood of a layer
// reaches the layer itself and the next, so no two layers of one colour write the same particle.
std::array<std::vector<CellRange>, 2> find_coloured_layers(const solver::CellGrid& grid, int dimensions);

// body(j) for the particles of `near` behind i in storage. Cells stand in storage in lexicographic order, so these are
// the particles after i in its own cell and those of the cells of higher number: the half neighbourhood.
template <class Body>
void for_each_later(const solver::Neighbourhood& near, solver::Index i, Body&& body) {
    for (int k = 0; k < near.runs; ++k) {
        for (solver::Index j = std::max(near.run[k].begin, i + 1); j < near.run[k].end; ++j) body(j);
    }
}

}  // namespace headrace::bench
