// Symmetric D x D matrices: moment matrices and their inverses. Stored xx, xy, yy in 2D; xx, xy, xz, yy, yz, zz in 3D.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "server/solver/lanes.h"

namespace headrace::solver {

inline constexpr int symmetric_size(int dimensions) {
    return dimensions * (dimensions + 1) / 2;
}

template <int D, class T = double>
struct Symmetric {
    static constexpr int kSize = symmetric_size(D);
    std::array<T, kSize> e{};

    HEADRACE_ALWAYS_INLINE static constexpr int index(int row, int column) {
        const int r = row < column ? row : column, c = row < column ? column : row;
        return r * D - r * (r - 1) / 2 + (c - r);
    }
    HEADRACE_ALWAYS_INLINE T& operator()(int row, int column) { return e[index(row, column)]; }
    HEADRACE_ALWAYS_INLINE const T& operator()(int row, int column) const { return e[index(row, column)]; }

    static Symmetric identity() {
        Symmetric one;
        for (int k = 0; k < D; ++k) one(k, k) = one(k, k) + 1.0;
        return one;
    }

    // Matrix times vector.
    HEADRACE_ALWAYS_INLINE std::array<T, D> operator*(const std::array<T, D>& u) const {
        std::array<T, D> product;
        for (int r = 0; r < D; ++r) {
            product[r] = (*this)(r, 0) * u[0];
            for (int c = 1; c < D; ++c) product[r] += (*this)(r, c) * u[c];
        }
        return product;
    }
};

inline double determinant(const Symmetric<2>& m) {
    return m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1);
}
inline double determinant(const Symmetric<3>& m) {
    return m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(1, 2)) - m(0, 1) * (m(0, 1) * m(2, 2) - m(1, 2) * m(0, 2)) +
           m(0, 2) * (m(0, 1) * m(1, 2) - m(1, 1) * m(0, 2));
}

// Precondition: determinant(m) != 0.
inline Symmetric<2> inverse(const Symmetric<2>& m) {
    const double f = 1.0 / determinant(m);
    return {{m(1, 1) * f, -m(0, 1) * f, m(0, 0) * f}};
}
inline Symmetric<3> inverse(const Symmetric<3>& m) {
    const double f = 1.0 / determinant(m);
    return {{(m(1, 1) * m(2, 2) - m(1, 2) * m(1, 2)) * f, (m(0, 2) * m(1, 2) - m(0, 1) * m(2, 2)) * f,
             (m(0, 1) * m(1, 2) - m(0, 2) * m(1, 1)) * f, (m(0, 0) * m(2, 2) - m(0, 2) * m(0, 2)) * f,
             (m(0, 1) * m(0, 2) - m(0, 0) * m(1, 2)) * f, (m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1)) * f}};
}

inline double smallest_eigenvalue(const Symmetric<2>& m) {
    const double mean = 0.5 * (m(0, 0) + m(1, 1)), half = 0.5 * (m(0, 0) - m(1, 1));
    return mean - std::sqrt(half * half + m(0, 1) * m(0, 1));
}
// Closed form by the angle of the characteristic polynomial's roots.
inline double smallest_eigenvalue(const Symmetric<3>& m) {
    const double mean = (m(0, 0) + m(1, 1) + m(2, 2)) / 3.0;
    Symmetric<3> deviator = m;
    for (int k = 0; k < 3; ++k) deviator(k, k) -= mean;
    double norm2 = 0.0;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) norm2 += deviator(r, c) * deviator(r, c);
    }
    const double scale = std::sqrt(norm2 / 6.0);
    if (scale <= 1e-14 * std::abs(mean)) return mean;
    const double cosine = std::clamp(determinant(deviator) / (2.0 * scale * scale * scale), -1.0, 1.0);
    return mean + 2.0 * scale * std::cos((std::acos(cosine) + 2.0 * std::numbers::pi) / 3.0);
}

}  // namespace headrace::solver
