// One pair of particles, or four to sixteen side by side: what every term of the accurate models starts from.
// T: double or Lanes<S, N>. Index i is the particle that sums, j its neighbour.
#pragma once

#include <array>

#include "server/solver/lanes.h"

namespace headrace::solver {

template <int D, class T>
using VectorOf = std::array<T, D>;

template <int D, class T>
struct Pair {
    VectorOf<D, T> x_ij;  // [m] x_i - x_j
    T r2;                 // [m^2] squared_distance(x_ij)
    T r;                  // [m]
    T V_j;                // [m^3] (2D: m^2); 0 where the pair does not interact
};

// Fields of a point, loaded.
template <class T, std::size_t N>
struct FieldsOf {
    std::array<T, N == 0 ? 1 : N> field;
    HEADRACE_ALWAYS_INLINE const T& operator()(std::size_t f) const { return field[f]; }
};

template <int D, class T>
HEADRACE_ALWAYS_INLINE T dot(const VectorOf<D, T>& a, const VectorOf<D, T>& b) {
    T sum = a[0] * b[0];
    for (int k = 1; k < D; ++k) sum += a[k] * b[k];
    return sum;
}

// Never 0: what is divided by it vanishes with x_ij, and the quotient where a point meets itself is 0.
template <int D, class T>
HEADRACE_ALWAYS_INLINE T squared_distance(const VectorOf<D, T>& x_ij) {
    T sum = tiny<T>() + x_ij[0] * x_ij[0];
    for (int k = 1; k < D; ++k) sum += x_ij[k] * x_ij[k];
    return sum;
}

template <int D, class T>
HEADRACE_ALWAYS_INLINE VectorOf<D, T> scaled(const T& factor, const VectorOf<D, T>& a) {
    VectorOf<D, T> product;
    for (int k = 0; k < D; ++k) product[k] = factor * a[k];
    return product;
}

template <int D, class T>
HEADRACE_ALWAYS_INLINE void add_to(VectorOf<D, T>& sum, const VectorOf<D, T>& a) {
    for (int k = 0; k < D; ++k) sum[k] += a[k];
}

}  // namespace headrace::solver
