#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "server/solver/pairs/instruction_sets.h"
#include "tests/bench/speed_sums.h"

using namespace headrace;
using bench::PairStrategy;
using bench::PlainFluid;

namespace {

constexpr PairStrategy kStrategies[] = {PairStrategy::clusters, PairStrategy::half, PairStrategy::buffer,
                                        PairStrategy::broadcast};

// What single precision may be off by.
struct Tolerance {
    double a{}, delta_rate{};  // [m/s^2], [1/s]
};

// Writes a and delta_rate, from all pairs in double precision.
//
// A term V F w x has some 20 roundings, n of them are added, and places are rounded at 4 R at most, which shifts a term
// by 6 eps of its largest value V |F(0)| w R: together (n + 26) eps of n such terms. For the rate of delta the same
// with v_ij . x_ij, and with deviations, which are rounded before their difference is taken.
template <int D>
Tolerance judge(PlainFluid& fluid) {
    using Pass = bench::PlainPass<D>;
    const Pass pass(fluid);
    const auto fields = pass.fluid_fields();
    std::vector<typename Pass::template Sums<double>> changed;  // stored at the end: pairs read the rates of before
    double most = 0.0, weight = 0.0, v = 0.0, V = 0.0, delta = 0.0;
    for (std::size_t i = 0; i < fluid.size(); ++i) {
        typename Pass::template Sums<double> sums;
        solver::FieldsOf<double, D + 1> self, neighbour;
        for (std::size_t f = 0; f <= D; ++f) self.field[f] = fields[f][i];
        double neighbours = 0.0;
        for (std::size_t j = 0; j < fluid.size(); ++j) {
            solver::Pair<D, double> pair;
            for (int k = 0; k < D; ++k)
                pair.x_ij[k] = std::remainder(fluid.x[k][i] - fluid.x[k][j], fluid.domain.max[k]);
            pair.r2 = solver::squared_distance<D, double>(pair.x_ij);
            pair.r = std::sqrt(pair.r2);
            pair.V_j = static_cast<double>(fluid.V[j]);
            for (std::size_t f = 0; f <= D; ++f) neighbour.field[f] = fields[f][j];
            pass.template pair<false>(self, pair, neighbour, sums);
            if (j == i || pair.r >= fluid.support) continue;
            double v2 = 0.0;
            for (std::size_t k = 0; k < D; ++k) v2 += std::pow(self(k) - neighbour(k), 2);
            const double pi_ij = Pass::kAlpha * 0.5 * fluid.support / fluid.sound_speed * std::sqrt(v2) / pair.r;
            weight = std::max(weight, std::abs(self(D) + neighbour(D)) + pi_ij);
            v = std::max(v, std::sqrt(v2));
            ++neighbours;
        }
        most = std::max(most, neighbours);
        V = std::max(V, static_cast<double>(fluid.V[i]));
        delta = std::max(delta, std::abs(self(D)));
        changed.push_back(sums);
    }
    for (std::size_t i = 0; i < fluid.size(); ++i) pass.store(static_cast<solver::Index>(i), changed[i]);
    const double eps = std::numeric_limits<float>::epsilon(), c = fluid.sound_speed;
    const double terms = (most + 26.0) * eps * most * V * std::abs(pass.kernel.F(0.0)) * fluid.support;
    return {terms * weight * c * c, terms * ((1.0 + delta) * v + 2.0 * solver::kUsualDiffusion * c * delta)};
}

struct Difference {
    double a{}, delta_rate{};
};

template <int D>
Difference find_difference(const PlainFluid& one, const PlainFluid& exact) {
    Difference worst;
    std::vector<std::size_t> place(one.size());  // of each id
    for (std::size_t i = 0; i < one.size(); ++i) place[one.id[i]] = i;
    for (std::size_t i = 0; i < one.size(); ++i) {
        const std::size_t in_one = place[exact.id[i]];
        const auto compare = [&](double largest, const std::vector<float>& a, const std::vector<float>& b) {
            return std::max(largest, std::abs(static_cast<double>(a[in_one]) - static_cast<double>(b[i])));
        };
        for (int k = 0; k < D; ++k) worst.a = compare(worst.a, one.a[k], exact.a[k]);
        worst.delta_rate = compare(worst.delta_rate, one.delta_rate, exact.delta_rate);
    }
    return worst;
}

template <int D>
void check_strategies(int edge, double support_over_dp) {
    for (const PairStrategy strategy : kStrategies) {
        CAPTURE(D, support_over_dp, bench::pair_strategy_name(strategy), solver::instruction_set());
        PlainFluid fluid = bench::make_plain_fluid(D, edge, support_over_dp);
        const auto sums = bench::make_plain_sums(strategy, D);
        bench::StageSeconds seconds;
        sums->compute(fluid, seconds);
        bench::start_plain_fluid(fluid);
        // Some steps: deviations and lists that are not new any more.
        PlainFluid exact;
        Tolerance tolerance;
        for (int step = 0; step < 3; ++step) {
            bench::advance_plain_fluid(fluid);
            if (step == 2) tolerance = judge<D>(exact = fluid);
            sums->compute(fluid, seconds);
        }
        // Small enough to tell: without one pair of average distance the sums would be off by far more.
        const bench::PlainPass<D> pass(exact);
        const double one_pair =
            static_cast<double>(exact.V[0]) * std::abs(pass.kernel.F(0.6 * exact.support)) * 0.6 * exact.support;
        const double c = exact.sound_speed;
        REQUIRE(tolerance.a < c * c * exact.delta()[0] * one_pair);
        const Difference difference = find_difference<D>(fluid, exact);
        CHECK(difference.a <= tolerance.a);
        CHECK(difference.delta_rate <= tolerance.delta_rate);
    }
}

}  // namespace

TEST_CASE("SpeedSums.StrategiesAgreeWithAllPairs") {
    check_strategies<3>(12, 2.4);
    check_strategies<3>(13, 4.0);
    check_strategies<2>(20, 3.0);
    check_strategies<2>(23, 4.0);
}

TEST_CASE("SpeedSums.InstructionSetsAgreeWithAllPairs") {
    for (const std::string& name : solver::instruction_sets()) {
        const solver::OnlyInstructionSet only(name);
        check_strategies<3>(12, 3.0);
    }
}

TEST_CASE("SpeedSums.HalfListsGiveTheSameBitsForAnyNumberOfThreads") {
    // Threads add to the same points' sums: in one order all the same.
    const int dimensions = GENERATE(2, 3), threads = GENERATE(2, 3, 4);
    const auto run = [&](int team) {
        omp_set_num_threads(team);
        PlainFluid fluid = bench::make_plain_fluid(dimensions, dimensions == 2 ? 80 : 20, 3.0);
        const auto sums = bench::make_plain_sums(PairStrategy::half, dimensions);
        bench::StageSeconds seconds;
        sums->compute(fluid, seconds);
        bench::start_plain_fluid(fluid);
        for (int step = 0; step < 30; ++step) {
            bench::advance_plain_fluid(fluid);
            sums->compute(fluid, seconds);
        }
        CHECK(sums->sorts() > 1);
        return fluid;
    };
    const int before = omp_get_max_threads();
    const PlainFluid one = run(1), many = run(threads);
    omp_set_num_threads(before);
    CHECK(one.x == many.x);
    CHECK(one.a == many.a);
    CHECK(one.delta_rate == many.delta_rate);
}

TEST_CASE("SpeedSums.ClustersReuseTheirLists") {
    PlainFluid fluid = bench::make_plain_fluid(3, 16, 3.0);
    const auto sums = bench::make_plain_sums(PairStrategy::clusters, 3);
    bench::StageSeconds seconds;
    sums->compute(fluid, seconds);
    sums->compute(fluid, seconds);  // nothing has moved
    CHECK(sums->sorts() == 1);
}
