// Every pass of the pair loop against plain sums over all pairs, for each instruction set of this processor and both
// precisions.
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "scenes.h"
#include "server/solver/models/wcsph/pair_terms.h"
#include "server/solver/models/wcsph/sums.h"
#include "server/solver/pairs/instruction_sets.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

constexpr double kSupport = 0.2, kSpacing = kSupport / 3.0;  // [m]

constexpr double kDouble = 1e-12, kSingle = 1e-3;
constexpr double kStored = 1.2e-7;  // rounding of what is kept in single precision, with either arithmetic
double tolerance = kDouble;

class Uniform {
  public:
    explicit Uniform(unsigned seed) : random_(seed) {}
    double operator()(double low = -1.0, double high = 1.0) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    template <class T>
    void fill(std::vector<T>& values, std::size_t count, double low = -1.0, double high = 1.0) {
        values.resize(count);
        for (T& value : values) value = static_cast<T>((*this)(low, high));
    }

  private:
    std::mt19937_64 random_;
};

// Random points and fields: fluid and walls mixed in one periodic box, nothing physical about them.
template <int D>
struct Bench {
    Domain domain{{0, 0, 0}, {0.7, 0.8, 0.66}, {true, false, true}};
    Particles particles;
    WcsphState state;
    WallParticles walls;
    WallState wall_state;
    ClusterOrder order, wall_order;
    std::size_t stride{1};  // one of so many points is checked

    // times: in 2D, as often in each direction.
    explicit Bench(unsigned seed, std::size_t times = 1) {
        Uniform uniform(seed);
        const std::size_t n = D == 2 ? 150 * times * times : 260, m = D == 2 ? 60 * times * times : 90;
        for (int k = 0; k < D; ++k) domain.max[k] *= static_cast<double>(times);
        particles.dimensions = walls.dimensions = D;
        particles.resize(n);
        walls.id.resize(m);
        for (std::size_t i = 0; i < n; ++i) particles.id[i] = static_cast<Index>(i);
        for (std::size_t w = 0; w < m; ++w) walls.id[w] = static_cast<Index>(w);
        for (int k = 0; k < D; ++k) {
            uniform.fill(particles.x[k], n, domain.min[k], domain.max[k]);
            uniform.fill(walls.x[k], m, domain.min[k], domain.max[k]);
        }
        sort();
        for (int k = 0; k < D; ++k) {
            for (VectorField* field : {&particles.v, &state.a_slow}) uniform.fill((*field)[k], n);
            for (VectorField* field : {&walls.v, &wall_state.g}) uniform.fill((*field)[k], m);
            uniform.fill(state.grad_delta[k], n);
            uniform.fill(walls.n[k], m);
            for (NarrowField* field : {&state.dx, &state.dv}) (*field)[k].assign(n, 0.0F);
        }
        for (int c = 0; c < symmetric_size(D); ++c) {
            for (MatrixField* field : {&state.B, &state.strain}) uniform.fill((*field)[c], n);
        }
        uniform.fill(particles.p, n);
        uniform.fill(particles.rho, n, 0.9, 1.1);
        uniform.fill(particles.m, n, 1e-3, 2e-3);
        uniform.fill(state.delta, n);
        uniform.fill(state.unevenness, n, 0.0, 0.2);
        for (std::vector<float>* field : {&state.min_eigenvalue, &state.ddelta}) field->assign(n, 1.0F);
        state.delta_rate.assign(n, 1.0);
        uniform.fill(walls.V, m, 1e-3, 2e-3);
        uniform.fill(walls.depth, m, 0.0, 0.1);
        uniform.fill(wall_state.p, m);
        wall_state.no_slip.resize(m);
        for (std::size_t w = 0; w < m; ++w) wall_state.no_slip[w] = w % 2 == 0 ? 1.0F : 0.0F;
    }

    void sort() {
        std::vector<double> scratch;
        std::vector<Index> scratch_id;
        order.build(particles.x, particles.id, D, kSpacing, domain);
        wall_order.build(walls.x, walls.id, D, kSpacing, domain);
        order.permute(particles.id, scratch_id);
        wall_order.permute(walls.id, scratch_id);
        for (int k = 0; k < D; ++k) {
            order.permute(particles.x[k], scratch);
            wall_order.permute(walls.x[k], scratch);
        }
    }

    PassData data() { return {particles, state, walls, wall_state}; }
    WcsphView view() const { return {particles, state, walls, wall_state}; }

    void find(PairNeighbours& neighbours) const {
        NeighbourInput in;
        in.dimensions = D;
        in.fluid = {&order, &particles.x, FieldView::quotient(particles.m, particles.rho), particles.size()};
        in.walls = {&wall_order, &walls.x, walls.V.data(), walls.size()};
        in.reach.support = kSupport;
        in.reach.skin = 0.1 * kSpacing;
        for (int k = 0; k < 3; ++k) in.reach.period[k] = domain.max[k] - domain.min[k];
        neighbours.find(in);
    }

    // visit(j, pair) for the points of `to` within the support of x, at their nearest images; periods are longer than
    // twice the support, so there is one.
    template <class Visit>
    void for_each_near(const std::array<double, D>& x, const VectorField& to, const FieldView& V, Visit&& visit) const {
        for (Index j = 0; j < to[0].size(); ++j) {
            std::array<double, D> x_ij;
            for (int k = 0; k < D; ++k) {
                x_ij[k] = x[k] - to[k][j];
                const double period = domain.max[k] - domain.min[k];
                if (domain.periodic[k]) x_ij[k] -= period * std::round(x_ij[k] / period);
            }
            const Pair<D, double> pair = make_pair_of<D>(x_ij, V[j]);
            if (pair.r < kSupport) visit(j, pair);
        }
    }
    template <class Visit>
    void for_each_fluid(const std::array<double, D>& x, Visit&& visit) const {
        for_each_near(x, particles.x, FieldView::quotient(particles.m, particles.rho), visit);
    }
    template <class Visit>
    void for_each_wall(const std::array<double, D>& x, Visit&& visit) const {
        for_each_near(x, walls.x, walls.V, visit);
    }
    std::array<double, D> x(std::size_t i) const { return vector_at<D>(particles.x, i); }
};

// Equal but for the order of summation: some hundred terms of a few digits' cancellation, 1e4 roundings.
bool is_same(double value, double expected, double scale) {
    return std::abs(value - expected) <= tolerance * std::max(scale, std::abs(expected));
}

bool is_same(float stored, double expected, double scale) {
    return is_same(static_cast<double>(stored), expected, scale) ||
           std::abs(static_cast<double>(stored) - expected) <= kStored * std::max(scale, std::abs(expected));
}

template <int D, class Field>
void require_same(const Field& field, std::size_t i, const std::array<double, D>& expected, double scale) {
    for (int k = 0; k < D; ++k) {
        INFO("particle " << i << ", axis " << k << ": " << field[k][i] << ", expected " << expected[k]);
        REQUIRE(is_same(field[k][i], expected[k], scale));
    }
}

template <class Field>
double largest_of(const Field& field) {
    double largest = 0.0;
    for (const auto& component : field) {
        for (const auto value : component) largest = std::max(largest, std::abs(static_cast<double>(value)));
    }
    return largest;
}

template <int D>
void check_geometry(Bench<D> bench, WcsphSums& sums) {
    GeometryOptions options;
    options.spacing = 0.1;
    options.correction_threshold = 0.5;
    options.shifting = options.reconstructs = true;
    options.rho0_c2 = 50.0;
    sums.geometry(bench.data(), options);
    const double scale = largest_of(bench.state.grad_delta);
    for (std::size_t i = 0; i < bench.particles.size(); i += bench.stride) {
        Symmetric<D> M;
        std::array<double, D> normal{}, grad_delta{};
        std::array<std::array<double, D>, D> grad_v{};
        const auto add = [&](const Pair<D, double>& pair, double delta_j, const std::array<double, D>& v_ij) {
            const double F = sums.F(pair.r);
            accumulate_moment<D, double>(pair, F, M);
            const std::array<double, D> grad = scaled<D, double>(pair.V_j * F, pair.x_ij);
            add_to<D, double>(normal, grad);
            add_to<D, double>(grad_delta, scaled<D, double>(delta_j - bench.state.delta[i], grad));
            for (int k = 0; k < D; ++k) add_to<D, double>(grad_v[k], scaled<D, double>(-v_ij[k], grad));
        };
        bench.for_each_fluid(bench.x(i), [&](Index j, const Pair<D, double>& pair) {
            std::array<double, D> v_ij;
            for (int k = 0; k < D; ++k) v_ij[k] = bench.particles.v[k][i] - bench.particles.v[k][j];
            add(pair, bench.state.delta[j], v_ij);
        });
        bench.for_each_wall(bench.x(i), [&](Index w, const Pair<D, double>& pair) {
            const std::array<double, D> n = vector_at<D>(bench.walls.n, w);
            std::array<double, D> v_ij;
            for (int k = 0; k < D; ++k) v_ij[k] = bench.particles.v[k][i] - bench.walls.v[k][w];
            const double normal_part = dot<D, double>(v_ij, n);
            if (bench.wall_state.no_slip[w] == 0.0F) v_ij = scaled<D, double>(normal_part, n);
            add(pair, static_cast<double>(bench.wall_state.p[w]) / 50.0, v_ij);
        });
        const double eigenvalue = smallest_eigenvalue(M);
        REQUIRE(is_same(bench.state.min_eigenvalue[i], eigenvalue, 1.0));
        // Inverting an ill-conditioned M would amplify the rounding that is compared here.
        if (eigenvalue < 0.31 || std::abs(eigenvalue - 0.5) < 1e-6) continue;
        const Symmetric<D> L = inverse(M), B = eigenvalue >= 0.5 ? L : Symmetric<D>::identity();
        for (int c = 0; c < symmetric_size(D); ++c) REQUIRE(is_same(bench.state.B[c][i], B.e[c], 10.0));
        REQUIRE(is_same(bench.state.unevenness[i], 0.1 * std::sqrt(dot<D, double>(normal, normal)), 1.0));
        require_same<D>(bench.state.grad_delta, i, L * grad_delta, scale);
        for (int k = 0; k < D; ++k) grad_v[k] = L * grad_v[k];
        for (int r = 0; r < D; ++r) {
            for (int c = r; c < D; ++c) {
                const double strain = 0.5 * (grad_v[r][c] + grad_v[c][r]);
                REQUIRE(is_same(bench.state.strain[Symmetric<D>::index(r, c)][i], strain, scale));
            }
        }
    }
}

template <int D>
void check_continuity(Bench<D> bench, WcsphSums& sums, DensityDiffusion form) {
    ContinuityOptions options;
    options.diffusion = 0.3;
    if (form == DensityDiffusion::fourtakas) options.g_over_c2 = {0.1, -0.5, 0.2};
    sums.continuity(bench.data(), form, options);
    const double scale = *std::max_element(bench.state.delta_rate.begin(), bench.state.delta_rate.end());
    for (std::size_t i = 0; i < bench.particles.size(); i += bench.stride) {
        const Symmetric<D> B = matrix_at<D>(bench.state.B, i);
        double divergence = 0.0, diffusion = 0.0;
        const auto add = [&](const Pair<D, double>& pair, const VectorField& v, Index j) {
            std::array<double, D> v_ij;
            for (int k = 0; k < D; ++k) v_ij[k] = bench.particles.v[k][i] - v[k][j];
            divergence += velocity_divergence<D, double>(pair.V_j * sums.F(pair.r), B * pair.x_ij, v_ij);
        };
        bench.for_each_fluid(bench.x(i), [&](Index j, const Pair<D, double>& pair) {
            add(pair, bench.particles.v, j);
            const double V_F = pair.V_j * sums.F(pair.r), delta_ij = bench.state.delta[i] - bench.state.delta[j];
            if (form == DensityDiffusion::antuono) {
                std::array<double, D> sum_grad = vector_at<D>(bench.state.grad_delta, i);
                add_to<D, double>(sum_grad, vector_at<D>(bench.state.grad_delta, j));
                diffusion += antuono_diffusion<D, double>(V_F, pair.x_ij, delta_ij, sum_grad);
            } else {
                double delta_H = 0.0;
                for (int k = 0; k < D; ++k) delta_H += options.g_over_c2[k] * pair.x_ij[k];
                diffusion += plain_diffusion<double>(V_F, delta_ij, delta_H);
            }
        });
        bench.for_each_wall(bench.x(i), [&](Index w, const Pair<D, double>& pair) { add(pair, bench.walls.v, w); });
        double rate = -(1.0 + bench.state.delta[i]) * divergence;
        if (form != DensityDiffusion::none) rate += options.diffusion * diffusion;
        INFO("particle " << i << ": " << bench.state.delta_rate[i] << ", expected " << rate);
        REQUIRE(is_same(bench.state.delta_rate[i], rate, scale));
    }
}

template <int D>
void check_pressure(Bench<D> bench, WcsphSums& sums, bool is_adjoint, double alpha) {
    TermOptions options;
    options.is_adjoint = is_adjoint;
    options.pressure.artificial_viscosity = alpha;
    options.pressure.controls_tension = is_adjoint;
    sums.pressure(bench.data(), is_adjoint, options.pressure);
    const WcsphView view = bench.view();
    const PairTerms<D> terms(view, options);
    const double scale = largest_of(bench.particles.a);
    for (std::size_t i = 0; i < bench.particles.size(); i += bench.stride) {
        std::array<double, D> a = vector_at<D>(bench.state.a_slow, i);
        const auto at = static_cast<Index>(i);
        bench.for_each_fluid(bench.x(i), [&](Index j, const Pair<D, double>& pair) {
            const double F = sums.F(pair.r);
            add_to<D, double>(a, terms.pressure(at, j, pair, F));
            add_to<D, double>(a, terms.artificial_viscosity(at, j, pair, F));
        });
        bench.for_each_wall(bench.x(i), [&](Index w, const Pair<D, double>& pair) {
            add_to<D, double>(a, terms.wall_pressure(at, w, pair, sums.F(pair.r)));
        });
        require_same<D>(bench.particles.a, i, a, scale);
    }
}

template <int D>
void check_viscosity(Bench<D> bench, WcsphSums& sums, bool is_morris) {
    TermOptions options;
    options.is_morris = is_morris;
    options.viscosity = {0.7, 0.01};
    const VectorField before = bench.state.a_slow;
    sums.viscosity(bench.data(), is_morris, options.viscosity);
    const WcsphView view = bench.view();
    const PairTerms<D> terms(view, options);
    const double scale = largest_of(bench.state.a_slow);
    for (std::size_t i = 0; i < bench.particles.size(); i += bench.stride) {
        std::array<double, D> a = vector_at<D>(before, i);
        const auto at = static_cast<Index>(i);
        bench.for_each_fluid(bench.x(i), [&](Index j, const Pair<D, double>& pair) {
            add_to<D, double>(a, terms.viscosity(at, j, pair, sums.F(pair.r)));
        });
        bench.for_each_wall(bench.x(i), [&](Index w, const Pair<D, double>& pair) {
            add_to<D, double>(a, terms.wall_viscosity(at, w, pair, sums.F(pair.r)));
        });
        require_same<D>(bench.state.a_slow, i, a, scale);
    }
}

template <int D>
void check_wall_pressure(Bench<D> bench, WcsphSums& sums, double least) {
    sums.wall_pressure(bench.data(), {least, {}});
    std::size_t clamped = 0;
    for (std::size_t w = 0; w < bench.walls.size(); w += bench.stride) {
        double W = 0.0, p = 0.0;
        bench.for_each_fluid(vector_at<D>(bench.walls.x, w), [&](Index j, const Pair<D, double>& pair) {
            const double weight = pair.V_j * sums.W(pair.r);
            W += weight;
            p += weight * bench.particles.p[j];
            p += weight * bench.particles.rho[j] * dot<D, double>(vector_at<D>(bench.wall_state.g, w), pair.x_ij);
        });
        p = W > 1e-12 ? std::max(p / W, least) : 0.0;
        clamped += p == least;
        REQUIRE(is_same(bench.wall_state.p[w], p, 10.0));
    }
    CHECK((clamped > 0) == (least == 0.0));
}

template <int D>
void check_all(KernelKind kernel) {
    const unsigned seed = 23;
    const Bench<D> bench(seed);
    for (const std::string& set : instruction_sets()) {
        for (const Arithmetic arithmetic : {Arithmetic::double_precision, Arithmetic::single_precision}) {
            const OnlyInstructionSet only(set);
            tolerance = arithmetic == Arithmetic::double_precision ? kDouble : kSingle;
            INFO(D << "D, kernel " << static_cast<int>(kernel) << ", " << set << ", tolerance " << tolerance
                   << ", seed " << seed);
            const auto neighbours = make_pair_neighbours(arithmetic);
            bench.find(*neighbours);
            const std::unique_ptr<WcsphSums> sums = make_wcsph_sums({D, kernel, kSupport}, *neighbours);
            check_geometry<D>(bench, *sums);
            using enum DensityDiffusion;
            for (const DensityDiffusion form : {none, molteni_colagrossi, fourtakas, antuono})
                check_continuity<D>(bench, *sums, form);
            for (const bool is_adjoint : {true, false}) {
                for (const double alpha : {0.0, 0.2}) check_pressure<D>(bench, *sums, is_adjoint, alpha);
            }
            for (const bool is_morris : {true, false}) check_viscosity<D>(bench, *sums, is_morris);
            for (const double least : {0.0, -std::numeric_limits<double>::infinity()})
                check_wall_pressure<D>(bench, *sums, least);
        }
    }
}

}  // namespace

TEST_CASE("WcsphSums.EveryPassIsThePlainSumOverAllPairs") {
    check_all<2>(KernelKind::wendland_c2);
    check_all<3>(KernelKind::wendland_c2);
}

TEST_CASE("WcsphSums.OtherKernelsPassTheSameLoop") {
    check_all<2>(KernelKind::quintic_spline);
    check_all<3>(KernelKind::wendland_c4);
    check_all<2>(KernelKind::cubic_spline);
}

TEST_CASE("WcsphSums.AreWholeOverMoreClustersThanAnEntryHasNumbersFor") {
    Bench<2> bench(23, 43);
    bench.stride = 1511;
    tolerance = kSingle;
    const auto neighbours = make_pair_neighbours(Arithmetic::single_precision);
    bench.find(*neighbours);
    REQUIRE(bench.order.clusters() > kMostWays * kBlockClusters);
    const std::unique_ptr<WcsphSums> sums = make_wcsph_sums({2, KernelKind::wendland_c2, kSupport}, *neighbours);
    check_continuity<2>(bench, *sums, DensityDiffusion::antuono);
    check_wall_pressure<2>(bench, *sums, 0.0);
    std::vector<std::vector<Index>> fluid_of(bench.walls.size());
    neighbours->for_each_wall_pair([&](Index wall, Index fluid) {
        if (wall % bench.stride == 0) fluid_of[wall].push_back(fluid);  // one thread has all of a wall's
    });
    std::size_t missing = 0;
    for (std::size_t w = 0; w < bench.walls.size(); w += bench.stride) {
        bench.for_each_fluid(vector_at<2>(bench.walls.x, w), [&](Index j, const Pair<2, double>&) {
            missing += std::find(fluid_of[w].begin(), fluid_of[w].end(), j) == fluid_of[w].end();
        });
    }
    CHECK(missing == 0);
}
