#include "tests/bench/strategy_sums.h"

#include <cmath>

#include "server/solver/forces/body_force.h"
#include "server/solver/forces/pressure.h"
#include "server/solver/forces/separation.h"
#include "server/solver/forces/surface_tension.h"
#include "server/solver/forces/viscosity.h"
#include "server/solver/kernels.h"
#include "server/solver/parallel.h"

namespace headrace::bench {

using solver::CellGrid;
using solver::Index;
using solver::Neighbourhood;
using solver::SumInput;

namespace {

// Occupied cells a thread takes at a time, as in the model.
constexpr std::size_t kCellBlock = 16;

template <int D>
using Point = std::array<double, D>;

template <int D>
Point<D> at(const solver::VectorField& field, Index i) {
    Point<D> value;
    for (int k = 0; k < D; ++k) value[k] = field[k][i];
    return value;
}

// A term says what two particles have in common, and what each gains from it:
//   Own        what is read of particle i once
//   Pair       the common part
//   meet()     forms the common part; false beyond the support radius
//   add()      what comes to `sum` from the other particle, `giver`; side is 1 for i, -1 for j
//   finish()   writes the result of particle i
// A particle meets itself once, as in the sums over j that include i.

// rho_i = sum_j m W_poly6(x_ij) (2.17)
template <int D>
class DensityTerm {
  public:
    using Sum = double;
    using Own = Point<D>;
    using Pair = double;

    DensityTerm(const SumInput& in, double* rho)
        : in_(in), poly6_(in.parameters.support_radius), m_(in.parameters.particle_mass), rho_(rho) {}

    Own own(Index i) const { return at<D>(in_.particles.x, i); }

    bool meet(const Own& x_i, Index j, Pair& W) const {
        double r2 = 0.0;
        for (int k = 0; k < D; ++k) {
            const double d = x_i[k] - in_.particles.x[k][j];
            r2 += d * d;
        }
        if (r2 >= poly6_.h2) return false;
        W = poly6_.W(r2);
        return true;
    }

    template <int Side>
    void add(Sum& sum, const Pair& W, Index) const {
        sum += W;
    }

    void finish(Index i, const Sum& sum) const { rho_[i] = m_ * sum; }

  private:
    const SumInput& in_;
    solver::Poly6<D> poly6_;
    double m_;
    double* rho_;
};

// a_i = (f_p + f_v + f_s)/rho_i + g (2.16). As Alg. 3.3 has it: all that two particles have in common is formed once,
// and each gains it times V = m/rho of the other, with opposite sign where it is a vector.
template <int D>
class ForceTerm {
  public:
    struct Sum {
        Point<D> f{};          // [N/m^3] of pressure and viscosity
        Point<D> n{};          // [1/m] gradient of the colour field
        double laplacian_c{};  // [1/m^2]
    };
    struct Own {
        Point<D> x, v;
        double p;
    };
    struct Pair {
        Point<D> f, n;
        double laplacian_c;
    };

    ForceTerm(const SumInput& in, const std::array<double*, 3>& a)
        : in_(in),
          spiky_(in.parameters.support_radius),
          viscosity_kernel_(in.parameters.support_radius),
          poly6_(in.parameters.support_radius),
          a_(a) {}

    Own own(Index i) const { return {at<D>(in_.particles.x, i), at<D>(in_.particles.v, i), in_.particles.p[i]}; }

    bool meet(const Own& i, Index j, Pair& pair) const {
        Point<D> x_ij;
        double r2 = 0.0;
        for (int k = 0; k < D; ++k) {
            x_ij[k] = i.x[k] - in_.particles.x[k][j];
            r2 += x_ij[k] * x_ij[k];
        }
        if (r2 >= poly6_.h2) return false;

        const double r = std::sqrt(r2);
        const double reach = solver::kCoincident * in_.parameters.support_radius;
        const double inv_r = r > reach ? 1.0 / r : 0.0;  // no direction: the particle itself
        // V_j = 1: the volume of the giver is the part not in common. The mean form does not read rho_i and m.
        const solver::PressurePair pressures{i.p, in_.particles.p[j], 0.0, 1.0, 0.0};
        const double f_p =
            -solver::pressure_weight<solver::PressureForm::mean>(pressures) * spiky_.gradient_factor(r, inv_r);
        const double f_v = solver::viscosity_weight(in_.parameters.viscosity, 1.0, viscosity_kernel_.laplacian(r));
        const double n = poly6_.gradient_factor(r2);
        for (int k = 0; k < D; ++k) {
            pair.f[k] = f_p * x_ij[k] + f_v * (in_.particles.v[k][j] - i.v[k]);
            pair.n[k] = n * x_ij[k];
        }
        pair.laplacian_c = poly6_.laplacian(r2);
        return true;
    }

    template <int Side>
    void add(Sum& sum, const Pair& pair, Index giver) const {
        const double V = in_.volume[giver];
        for (int k = 0; k < D; ++k) {
            sum.f[k] += Side * V * pair.f[k];
            sum.n[k] += Side * V * pair.n[k];
        }
        sum.laplacian_c += V * pair.laplacian_c;
    }

    void finish(Index i, const Sum& sum) const {
        double n2 = 0.0;
        for (int k = 0; k < D; ++k) n2 += sum.n[k] * sum.n[k];
        const solver::ThesisParameters& parameters = in_.parameters;
        const double f_s = solver::tension_factor(parameters.surface_tension, sum.laplacian_c, n2,
                                                  parameters.surface_tension_threshold);
        for (int k = 0; k < D; ++k)
            a_[k][i] =
                (sum.f[k] + f_s * sum.n[k]) / in_.particles.rho[i] + solver::body_acceleration(parameters.gravity[k]);
    }

  private:
    const SumInput& in_;
    solver::Spiky<D> spiky_;
    solver::ViscosityKernel<D> viscosity_kernel_;
    solver::Poly6<D> poly6_;
    std::array<double*, 3> a_;
};

template <class Term>
void sum_all_pairs(const Term& term, std::size_t particles) {
    const auto count = static_cast<Index>(particles);
    for (Index i = 0; i < count; ++i) {
        const typename Term::Own own = term.own(i);
        typename Term::Sum sum{};
        typename Term::Pair pair;
        for (Index j = 0; j < count; ++j) {
            if (term.meet(own, j, pair)) term.template add<1>(sum, pair, j);
        }
        term.finish(i, sum);
    }
}

template <class Term>
void sum_linked_cells(const Term& term, const CellGrid& grid) {
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        const Neighbourhood near = grid.around(c);
        const solver::Run cell = grid.cell(c);
        for (Index i = cell.begin; i < cell.end; ++i) {
            const typename Term::Own own = term.own(i);
            typename Term::Sum sum{};
            typename Term::Pair pair;
            for (int k = 0; k < near.runs; ++k) {
                for (Index j = near.run[k].begin; j < near.run[k].end; ++j) {
                    if (term.meet(own, j, pair)) term.template add<1>(sum, pair, j);
                }
            }
            term.finish(i, sum);
        }
    }
}

// Adds the pairs of `cells` with their half neighbourhood to the sums of both.
template <class Term>
void add_half_neighbourhood(const Term& term, const CellGrid& grid, const CellRange& cells,
                            std::vector<typename Term::Sum>& sums) {
    for (std::size_t c = cells.first; c < cells.last; ++c) {
        const Neighbourhood near = grid.around(c);
        const solver::Run cell = grid.cell(c);
        for (Index i = cell.begin; i < cell.end; ++i) {
            const typename Term::Own own = term.own(i);
            typename Term::Sum sum = sums[i];
            typename Term::Pair pair;
            if (term.meet(own, i, pair)) term.template add<1>(sum, pair, i);
            for_each_later(near, i, [&](Index j) {
                if (!term.meet(own, j, pair)) return;
                term.template add<1>(sum, pair, j);
                term.template add<-1>(sums[j], pair, i);
            });
            sums[i] = sum;
        }
    }
}

template <class Term>
void sum_symmetry(const Term& term, const CellGrid& grid, std::vector<typename Term::Sum>& sums) {
    std::fill(sums.begin(), sums.end(), typename Term::Sum{});
    add_half_neighbourhood(term, grid, {0, grid.cells()}, sums);
    for (std::size_t i = 0; i < sums.size(); ++i) term.finish(static_cast<Index>(i), sums[i]);
}

// The order of the additions to a particle is that of colours and, within its layer, of cells: never of threads.
template <class Term>
void sum_coloured_layers(const Term& term, const CellGrid& grid, int dimensions,
                         std::vector<typename Term::Sum>& sums) {
    using solver::kParticleBlock;
    solver::parallel_for(sums.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) sums[i] = {};
    });
    for (const std::vector<CellRange>& layers : find_coloured_layers(grid, dimensions)) {
        solver::parallel_for(layers.size(), 1, [&](std::size_t layer, std::size_t, int) {
            add_half_neighbourhood(term, grid, layers[layer], sums);
        });
    }
    solver::parallel_for(sums.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) term.finish(static_cast<Index>(i), sums[i]);
    });
}

template <int D>
class ScalarSums final : public StrategySums {
  public:
    explicit ScalarSums(Strategy strategy) : strategy_(strategy) {}

    void compute_density(const SumInput& in, double* rho) override { sum(DensityTerm<D>(in, rho), in, rho_sums_); }
    void compute_acceleration(const SumInput& in, const std::array<double*, 3>& a) override {
        sum(ForceTerm<D>(in, a), in, force_sums_);
    }

  private:
    template <class Term>
    void sum(const Term& term, const SumInput& in, std::vector<typename Term::Sum>& sums) const {
        if (strategy_ == Strategy::all_pairs) return sum_all_pairs(term, in.particles.size());
        if (strategy_ == Strategy::linked_cells) return sum_linked_cells(term, in.grid);
        sums.resize(in.particles.size());
        if (strategy_ == Strategy::symmetry) return sum_symmetry(term, in.grid, sums);
        sum_coloured_layers(term, in.grid, D, sums);
    }

    Strategy strategy_;
    // [N] of the half neighbourhood, which adds to particles before and after their turn
    std::vector<typename DensityTerm<D>::Sum> rho_sums_;
    std::vector<typename ForceTerm<D>::Sum> force_sums_;
};

class SimdSums final : public StrategySums {
  public:
    SimdSums(int dimensions, solver::Isa isa)
        : density_sum_(solver::choose_density_sum(dimensions, isa)),
          force_sum_(solver::choose_force_sum(dimensions, {}, isa)) {}

    void compute_density(const SumInput& in, double* rho) override {
        for_each_block(in.grid, [&](std::size_t first, std::size_t last, solver::Candidates& candidates) {
            density_sum_(in, first, last, candidates, rho);
        });
    }
    void compute_acceleration(const SumInput& in, const std::array<double*, 3>& a) override {
        for_each_block(in.grid, [&](std::size_t first, std::size_t last, solver::Candidates& candidates) {
            force_sum_(in, first, last, candidates, a);
        });
    }

  private:
    template <class Body>
    void for_each_block(const CellGrid& grid, Body&& body) {
        candidates_.resize(static_cast<std::size_t>(solver::max_threads()));
        solver::parallel_for(grid.cells(), kCellBlock, [&](std::size_t first, std::size_t last, int thread) {
            body(first, last, candidates_[thread]);
        });
    }

    solver::DensitySum density_sum_;
    solver::ForceSum force_sum_;
    std::vector<solver::Candidates> candidates_;  // one per thread
};

}  // namespace

std::string_view strategy_name(Strategy strategy) {
    switch (strategy) {
        case Strategy::all_pairs:
            return "all_pairs";
        case Strategy::linked_cells:
            return "linked_cells";
        case Strategy::symmetry:
            return "symmetry";
        case Strategy::coloured_layers:
            return "coloured_layers";
        case Strategy::simd:
            break;
    }
    return "simd";
}

std::unique_ptr<StrategySums> make_strategy_sums(Strategy strategy, int dimensions, solver::Isa isa) {
    if (strategy == Strategy::simd) return std::make_unique<SimdSums>(dimensions, isa);
    if (dimensions == 3) return std::make_unique<ScalarSums<3>>(strategy);
    return std::make_unique<ScalarSums<2>>(strategy);
}

std::array<std::vector<CellRange>, 2> find_coloured_layers(const CellGrid& grid, int dimensions) {
    std::array<std::vector<CellRange>, 2> layers;
    const auto layer_of = [&](std::size_t c) { return grid.coordinates(c)[3 - dimensions]; };  // z, or y in 2D
    for (std::size_t first = 0, last = 0; first < grid.cells(); first = last) {
        while (last < grid.cells() && layer_of(last) == layer_of(first)) ++last;
        layers[layer_of(first) & 1].push_back({first, last});
    }
    return layers;
}

}  // namespace headrace::bench
