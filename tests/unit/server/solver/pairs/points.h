// Random points for the tests of the pair engine, in its order.
#pragma once

#include <random>

#include "server/solver/pairs/pair_neighbours.h"

namespace headrace::solver::testing {

struct Points {
    int dimensions{3};
    double spacing{1.0};  // [m]
    Domain domain{{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
    VectorField x;
    std::vector<Index> id;
    std::vector<double> V;
    ClusterOrder order;

    Vec3 period() const {
        Vec3 period{};
        for (int k = 0; k < 3; ++k) period[k] = domain.max[k] - domain.min[k];
        return period;
    }
    std::size_t size() const { return id.size(); }

    void add(const Vec3& place) {
        for (int k = 0; k < dimensions; ++k) x[k].push_back(place[k]);
        id.push_back(static_cast<Index>(id.size()));
        V.push_back(1.0);
    }
    // `count` points in the box [low, high].
    void fill(std::size_t count, const Vec3& low, const Vec3& high, unsigned seed) {
        std::mt19937_64 random(seed);
        for (std::size_t i = 0; i < count; ++i) {
            Vec3 place{};
            for (int k = 0; k < dimensions; ++k)
                place[k] = std::uniform_real_distribution<double>(low[k], high[k])(random);
            add(place);
        }
    }
    void sort() {
        std::vector<double> scratch;
        std::vector<Index> scratch_id;
        order.build(x, id, dimensions, spacing, domain);
        order.permute(id, scratch_id);
        for (int k = 0; k < dimensions; ++k) order.permute(x[k], scratch);
    }
    OrderedPoints ordered() const { return {&order, &x, V.data(), size()}; }
    Vec3 at(std::size_t i) const {
        Vec3 place{};
        for (int k = 0; k < dimensions; ++k) place[k] = x[k][i];
        return place;
    }
    // Distance to the nearest image.
    double distance(std::size_t i, std::size_t j) const {
        double r2 = 0.0;
        for (int k = 0; k < dimensions; ++k) {
            double d = x[k][i] - x[k][j];
            if (domain.periodic[k]) d -= period()[k] * std::round(d / period()[k]);
            r2 += d * d;
        }
        return std::sqrt(r2);
    }
};

}  // namespace headrace::solver::testing
