// What a collision object says about a particle it has caught. Points have D components.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace headrace::solver {

template <int D>
using Point = std::array<double, D>;

template <int D>
struct Contact {
    Point<D> cp;  // [m] contact point, on the surface
    Point<D> n;   // [1] unit normal, towards the side where the particle belongs
    double d;     // [m] penetration depth
};

template <int D>
double dot(const Point<D>& a, const Point<D>& b) {
    double sum = 0.0;
    for (int k = 0; k < D; ++k) sum += a[k] * b[k];
    return sum;
}

template <int D>
Point<D> difference(const Point<D>& a, const Point<D>& b) {
    Point<D> result;
    for (int k = 0; k < D; ++k) result[k] = a[k] - b[k];
    return result;
}

}  // namespace headrace::solver
