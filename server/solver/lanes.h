// Eight doubles side by side: the number type of the vectorised pair loops. Formulas are templates over the number
// type, so the same text serves one pair (double: tests, sim.inspect) and eight at a time (Lanes).
//
// Always eight, on every instruction set: the compiler splits the operations where vectors are shorter, so the order
// of summation does not depend on the machine.
#pragma once

#include <cmath>
#include <cstddef>

#define HEADRACE_ALWAYS_INLINE [[gnu::always_inline]] inline

namespace headrace::solver {

inline constexpr std::size_t kLanes = 8;

using Lanes [[gnu::vector_size(64)]] = double;

HEADRACE_ALWAYS_INLINE Lanes load_lanes(const double* aligned) {
    using LanesInMemory [[gnu::vector_size(64), gnu::may_alias]] = double;
    return *reinterpret_cast<const LanesInMemory*>(aligned);
}

// Lane 0 first: one order for every machine.
HEADRACE_ALWAYS_INLINE double sum_lanes(const Lanes& a) {
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}
HEADRACE_ALWAYS_INLINE double sum_lanes(double a) {
    return a;
}

HEADRACE_ALWAYS_INLINE Lanes square_root(const Lanes& a) {
    Lanes root;
    for (std::size_t k = 0; k < kLanes; ++k) root[k] = std::sqrt(a[k]);
    return root;
}
HEADRACE_ALWAYS_INLINE double square_root(double a) {
    return std::sqrt(a);
}

// where(a < b, x, y): x where the condition holds, else y.
template <class T>
HEADRACE_ALWAYS_INLINE T less_or(const T& a, const T& b, const T& x, const T& y) {
    return a < b ? x : y;
}
template <class T>
HEADRACE_ALWAYS_INLINE T maximum(const T& a, const T& b) {
    return a < b ? b : a;
}
template <class T>
HEADRACE_ALWAYS_INLINE T minimum(const T& a, const T& b) {
    return b < a ? b : a;
}
template <class T>
HEADRACE_ALWAYS_INLINE T positive_or_zero(const T& a) {
    return a > 0.0 ? a : T{};
}

// The same number in every lane.
template <class T>
HEADRACE_ALWAYS_INLINE T splat(double a) {
    return T{} + a;
}

}  // namespace headrace::solver
