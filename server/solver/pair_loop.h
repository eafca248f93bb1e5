// The pair loop of the accurate models, written once: a pass says which fields it reads, what a pair contributes and
// where the sum goes.
//
// Each cell's candidates are copied side by side (candidates.h) and read by every particle of the cell, eight at a
// time. Fluid and wall candidates are two segments with their own terms; without walls in reach the second is empty.
//
// A Pass has
//   kFluidFields, kWallFields   how many fields it reads of a neighbour, beside x and V
//   fluid_fields(), wall_fields()   their arrays, in the neighbours' order
//   Self load(i)                what it needs of the centre particle
//   Sums                        accumulators, made of Lanes, starting at 0
//   pair<IsWall>(self, pair, neighbour, sums)   neighbour(f): field f of the eight neighbours
//   store(i, self, sums)        sum_lanes() and write
#pragma once

#include <array>
#include <span>

#include "server/solver/candidates.h"
#include "server/solver/neighbours.h"
#include "server/solver/pair.h"
#include "server/solver/visibility.h"

namespace headrace::solver {

// Points in the order of their grid.
struct PointSet {
    const CellGrid* grid{};  // null: no points
    const VectorField* x{};
    const double* V{};
};

struct PairInput {
    PointSet centres;  // whose sums are formed: the fluid, or the walls
    PointSet fluid;
    PointSet walls;                  // grid is null where the pass knows no walls
    Vec3 period{};                   // [m]
    double support{};                // [m]
    const Visibility* thin_walls{};  // null unless pairs may be separated by a thin panel
    bool centres_are_walls{false};
};

// Scratch of one thread.
struct PairScratch {
    Candidates fluid, walls;
};

// Copies x, V and the fields of the particles in `near`, displaced by their periods. Returns the padded count.
template <int D, std::size_t Fields>
HEADRACE_ALWAYS_INLINE std::size_t gather_points(Candidates& candidates, const Neighbourhood& near,
                                                 const PointSet& points, const Vec3& period,
                                                 const std::array<const double*, Fields>& fields) {
    std::array<const double*, D + 1 + Fields> all;
    for (int k = 0; k < D; ++k) all[k] = (*points.x)[k].data();
    all[D] = points.V;
    for (std::size_t f = 0; f < Fields; ++f) all[D + 1 + f] = fields[f];
    const std::size_t padded = candidates.gather(near, all);
    std::size_t at = 0;
    for (int run = 0; run < near.runs; ++run) {
        const std::size_t length = near.run[run].end - near.run[run].begin;
        for (int k = 0; k < D; ++k) {
            if (near.run[run].image[k] == 0) continue;
            const double shift = near.run[run].image[k] * period[k];
            double* x = candidates.field(k) + at;
            for (std::size_t j = 0; j < length; ++j) x[j] += shift;
        }
        at += length;
    }
    return padded;
}

template <int D, bool IsWall, class Pass>
HEADRACE_ALWAYS_INLINE void sum_candidates(const Pass& pass, const typename Pass::Self& self,
                                           const std::array<double, D>& x_i, Candidates& candidates, const double* V,
                                           std::size_t count, typename Pass::Sums& sums) {
    std::array<const double*, D> x;
    for (int k = 0; k < D; ++k) x[k] = candidates.field(k);
    constexpr std::size_t kFields = IsWall ? Pass::kWallFields : Pass::kFluidFields;
    std::array<const double*, kFields == 0 ? 1 : kFields> fields;
    for (std::size_t f = 0; f < kFields; ++f) fields[f] = candidates.field(D + 1 + f);
    for (std::size_t j = 0; j < count; j += kLanes) {
        Pair<D, Lanes> pair;
        for (int k = 0; k < D; ++k) pair.x_ij[k] = x_i[k] - load_lanes(x[k] + j);
        pair.r2 = dot<D, Lanes>(pair.x_ij, pair.x_ij);
        pair.r = square_root(pair.r2);
        pair.V_j = load_lanes(V + j);
        pass.template pair<IsWall>(
            self, pair, [&](std::size_t f) __attribute__((always_inline)) { return load_lanes(fields[f] + j); }, sums);
    }
}

// Where thin panels are near: the volumes of the candidates that the particle at x_i does not see are set to 0.
template <int D>
[[gnu::noinline]] void hide_candidates(const PairInput& in, const std::array<double, D>& x_i, const Neighbourhood& near,
                                       const Neighbourhood& near_walls, Candidates& fluid, Candidates& walls) {
    const auto point = [](Candidates& from, std::size_t j) {
        Vec3 x{};
        for (int k = 0; k < D; ++k) x[k] = from.field(k)[j];
        return x;
    };
    Vec3 here{};
    for (int k = 0; k < D; ++k) here[k] = x_i[k];
    const double reach2 = in.support * in.support;
    const auto is_near = [&](const Vec3& x) {
        double r2 = 0.0;
        for (int k = 0; k < D; ++k) r2 += (x[k] - here[k]) * (x[k] - here[k]);
        return r2 < reach2;
    };
    for (std::size_t j = 0, run = 0, slot = 0; run < static_cast<std::size_t>(near.runs); ++run) {
        for (slot = near.run[run].begin; slot < near.run[run].end; ++slot, ++j) {
            const Vec3 x = point(fluid, j);
            fluid.field(D)[j] = is_near(x) && in.thin_walls->is_blocked(here, x) ? 0.0 : in.fluid.V[slot];
        }
    }
    for (std::size_t j = 0, run = 0, slot = 0; run < static_cast<std::size_t>(near_walls.runs); ++run) {
        for (slot = near_walls.run[run].begin; slot < near_walls.run[run].end; ++slot, ++j) {
            const bool is_seen = is_near(point(walls, j)) && in.thin_walls->sees(here, slot);
            walls.field(D)[j] = is_seen ? in.walls.V[slot] : 0.0;
        }
    }
}

// The same where the centres are wall particles: fluid on the far side of a thin panel is hidden from a sheet.
template <int D>
[[gnu::noinline]] void hide_fluid_from_wall(const PairInput& in, Index wall, const Neighbourhood& near,
                                            Candidates& fluid) {
    Vec3 x_wall{};
    for (int k = 0; k < D; ++k) x_wall[k] = (*in.centres.x)[k][wall];
    for (std::size_t j = 0, run = 0, slot = 0; run < static_cast<std::size_t>(near.runs); ++run) {
        for (slot = near.run[run].begin; slot < near.run[run].end; ++slot, ++j) {
            Vec3 x{};
            double r2 = 0.0;
            for (int k = 0; k < D; ++k) {
                x[k] = fluid.field(k)[j];
                r2 += (x[k] - x_wall[k]) * (x[k] - x_wall[k]);
            }
            const bool is_seen = r2 < in.support * in.support && in.thin_walls->sees(x, wall);
            fluid.field(D)[j] = is_seen ? in.fluid.V[slot] : 0.0;
        }
    }
}

// The pass for the centres in the cells [first, last).
template <int D, class Pass>
HEADRACE_ALWAYS_INLINE void sum_over_pairs(const PairInput& in, const Pass& pass, std::size_t first, std::size_t last,
                                           PairScratch& scratch) {
    constexpr bool kHasWalls = Pass::kReadsWalls;
    for (std::size_t c = first; c < last; ++c) {
        const Run cell = in.centres.grid->cell(c);
        const CellGrid::Coordinates here = in.centres.grid->coordinates(c);
        const Neighbourhood near = in.fluid.grid->around(here);
        const std::size_t count = gather_points<D>(scratch.fluid, near, in.fluid, in.period, pass.fluid_fields());
        Neighbourhood near_walls;
        std::size_t wall_count = 0;
        if constexpr (kHasWalls) {
            if (in.walls.grid != nullptr) {
                near_walls = in.walls.grid->around(here);
                wall_count = gather_points<D>(scratch.walls, near_walls, in.walls, in.period, pass.wall_fields());
            }
        }
        bool is_near_thin = false;
        if (in.thin_walls != nullptr) {
            Vec3 x{};
            for (int k = 0; k < D; ++k) x[k] = (*in.centres.x)[k][cell.begin];
            // A cell's diagonal away at most: sqrt(3) (R + skin) < 2.5 R.
            is_near_thin = in.thin_walls->is_near_thin(x, 2.5 * in.support);
        }
        for (Index i = cell.begin; i < cell.end; ++i) {
            std::array<double, D> x_i;
            for (int k = 0; k < D; ++k) x_i[k] = (*in.centres.x)[k][i];
            if (is_near_thin) {
                if (in.centres_are_walls) {
                    hide_fluid_from_wall<D>(in, i, near, scratch.fluid);
                } else {
                    hide_candidates<D>(in, x_i, near, near_walls, scratch.fluid, scratch.walls);
                }
            }
            const typename Pass::Self self = pass.load(i);
            typename Pass::Sums sums{};
            sum_candidates<D, false>(pass, self, x_i, scratch.fluid, scratch.fluid.field(D), count, sums);
            if constexpr (kHasWalls) {
                if (wall_count > 0)
                    sum_candidates<D, true>(pass, self, x_i, scratch.walls, scratch.walls.field(D), wall_count, sums);
            }
            pass.store(i, self, sums);
        }
    }
}

}  // namespace headrace::solver
