// Several numbers side by side: the number type of the vectorised pair loops. Formulas are templates over the number
// type, so the same text serves one pair (double: tests, sim.inspect) and a vector of pairs.
//
// Only operators that every instruction set has: the loops that use them are compiled for each, and these are inlined
// into them. What needs an instruction of its own (square root, loads that repeat) is in pairs/lane_loads-inl.h.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#define HEADRACE_ALWAYS_INLINE [[gnu::always_inline]] inline

namespace headrace::solver {

// S: float or double; N: a power of two.
template <class S, std::size_t N>
struct Lanes {
    using Scalar = S;
    using Vector [[gnu::vector_size(sizeof(S) * N)]] = S;
    static constexpr std::size_t kCount = N;

    Vector v;  // not set by itself: fields that are loaded one by one would be cleared first

    Lanes() = default;
    HEADRACE_ALWAYS_INLINE Lanes(const Vector& vector) : v(vector) {}
    // The same number in every lane.
    HEADRACE_ALWAYS_INLINE Lanes(double a) : v(Vector{} + static_cast<S>(a)) {}

    HEADRACE_ALWAYS_INLINE S operator[](std::size_t k) const { return v[k]; }

    HEADRACE_ALWAYS_INLINE Lanes& operator+=(const Lanes& b) {
        v += b.v;
        return *this;
    }
    HEADRACE_ALWAYS_INLINE Lanes& operator-=(const Lanes& b) {
        v -= b.v;
        return *this;
    }
    HEADRACE_ALWAYS_INLINE Lanes& operator*=(const Lanes& b) {
        v *= b.v;
        return *this;
    }
    HEADRACE_ALWAYS_INLINE friend Lanes operator-(const Lanes& a) { return Lanes(Vector(-a.v)); }
    HEADRACE_ALWAYS_INLINE friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(Vector(a.v + b.v)); }
    HEADRACE_ALWAYS_INLINE friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(Vector(a.v - b.v)); }
    HEADRACE_ALWAYS_INLINE friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(Vector(a.v * b.v)); }
    HEADRACE_ALWAYS_INLINE friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(Vector(a.v / b.v)); }
    HEADRACE_ALWAYS_INLINE friend auto operator<(const Lanes& a, const Lanes& b) { return a.v < b.v; }
};

// less_or(a, b, x, y): x where a < b, else y.
HEADRACE_ALWAYS_INLINE double less_or(double a, double b, double x, double y) {
    return a < b ? x : y;
}
template <class S, std::size_t N>
HEADRACE_ALWAYS_INLINE Lanes<S, N> less_or(const Lanes<S, N>& a, const Lanes<S, N>& b, const Lanes<S, N>& x,
                                           const Lanes<S, N>& y) {
    return Lanes<S, N>(a.v < b.v ? x.v : y.v);
}
template <class T>
HEADRACE_ALWAYS_INLINE T maximum(const T& a, const T& b) {
    return less_or(a, b, b, a);
}
template <class T>
HEADRACE_ALWAYS_INLINE T minimum(const T& a, const T& b) {
    return less_or(b, a, b, a);
}
HEADRACE_ALWAYS_INLINE double positive_or_zero(double a) {
    return a > 0.0 ? a : 0.0;
}
// Numbers that are not negative compare as the integers of their bits do, and negative ones have a negative integer:
// one instruction, where the same choice between floating-point numbers takes two. NaN: 0 or NaN, by its sign.
template <class S, std::size_t N>
HEADRACE_ALWAYS_INLINE Lanes<S, N> positive_or_zero(const Lanes<S, N>& a) {
    using Bits = decltype(a.v < a.v);
    const Bits bits = __builtin_bit_cast(Bits, a.v);
    const Bits larger = bits > 0 ? bits : Bits{};
    return Lanes<S, N>(__builtin_bit_cast(typename Lanes<S, N>::Vector, larger));
}

template <class T>
struct ScalarOf {
    using type = T;
};
template <class S, std::size_t N>
struct ScalarOf<Lanes<S, N>> {
    using type = S;
};

// The smallest normal number.
template <class T>
HEADRACE_ALWAYS_INLINE T tiny() {
    return T(static_cast<double>(std::numeric_limits<typename ScalarOf<T>::type>::min()));
}

// The same number in every lane.
template <class T>
HEADRACE_ALWAYS_INLINE T splat(double a) {
    return T(a);
}

}  // namespace headrace::solver
