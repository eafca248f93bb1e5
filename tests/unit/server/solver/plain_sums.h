// Sums over all pairs of a few points, one pair at a time with the formulas' scalar form.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "server/solver/pair.h"
#include "server/solver/smoothing_kernels.h"
#include "server/solver/symmetric.h"

namespace headrace::solver::testing {

template <int D>
struct Cloud {
    std::vector<std::array<double, D>> x;  // [m]
    std::vector<double> V;                 // [m^D]
    double R{};                            // [m] support

    WendlandC2<D> kernel() const { return WendlandC2<D>(R); }

    // visit(j, pair, F) for the neighbours of i, itself left out.
    template <class Visit>
    void for_each_neighbour(std::size_t i, Visit&& visit) const {
        for (std::size_t j = 0; j < x.size(); ++j) {
            if (j == i) continue;
            Pair<D, double> pair{};
            for (int k = 0; k < D; ++k) pair.x_ij[k] = x[i][k] - x[j][k];
            pair.r2 = squared_distance<D, double>(pair.x_ij);
            pair.r = std::sqrt(pair.r2);
            pair.V_j = V[j];
            if (pair.r < R) visit(j, pair, kernel().F(pair.r));
        }
    }

    // The particle nearest to the middle: it has full support.
    std::size_t middle() const {
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (dot<D, double>(x[i], x[i]) < dot<D, double>(x[nearest], x[nearest])) nearest = i;
        }
        return nearest;
    }
};

// Points of a lattice of spacing 1 around the origin, n to each side, displaced by up to `jitter`; R = 3.
template <int D>
Cloud<D> make_cloud(int n, double jitter, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-jitter, jitter);
    Cloud<D> cloud;
    cloud.R = 3.0;
    const int z_end = D == 3 ? n : 0;
    for (int k = -z_end; k <= z_end; ++k) {
        for (int j = -n; j <= n; ++j) {
            for (int i = -n; i <= n; ++i) {
                const std::array<int, 3> at{i, j, k};
                std::array<double, D> x;
                for (int d = 0; d < D; ++d) x[d] = at[d] + uniform(random);
                cloud.x.push_back(x);
                cloud.V.push_back(1.0 + uniform(random));
            }
        }
    }
    return cloud;
}

// a + b . x, the field that first-order forms know exactly.
template <int D>
struct LinearField {
    double a{};
    std::array<double, D> b{};
    double operator()(const std::array<double, D>& x) const { return a + dot<D, double>(b, x); }
};

}  // namespace headrace::solver::testing
