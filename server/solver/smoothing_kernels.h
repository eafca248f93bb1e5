// Kernels of the accurate models, as functions of r^2 or r and the support radius R. Where a source uses the smoothing
// length h, R = 2 h (cubic spline, Wendland) or 3 h (quintic spline). Ours: h = R/2 for every kernel, in every term
// that needs a smoothing length.
//
// F(r) = W'(r)/r <= 0, so that grad_i W_ij = F x_ij: no division by r. dF_dr is its derivative. All are 0 at and
// beyond R.
// T: double or Lanes<S, N>.
#pragma once

#include <numbers>
#include <string_view>

#include "server/solver/lanes.h"

namespace headrace::solver {

enum class KernelKind { wendland_c2, wendland_c4, cubic_spline, quintic_spline };

// W = N (1-s)^4 (1+4s), F = -20 N/R^2 (1-s)^3, s = r/R; N = 7/(pi R^2) in 2D, 21/(2 pi R^3) in 3D.
// Wendland 1995; as used in SPH: Dehnen & Aly 2012, Table 1 (C2).
template <int D>
class WendlandC2 {
  public:
    explicit WendlandC2(double R)
        : inv_R_(1.0 / R),
          norm_(D == 2 ? 7.0 / (std::numbers::pi * R * R) : 21.0 / (2.0 * std::numbers::pi * R * R * R)),
          slope_(-20.0 * norm_ / (R * R)) {}

    template <class T>
    HEADRACE_ALWAYS_INLINE T W(const T& r) const {
        const T s = r * inv_R_, u = positive_or_zero(1.0 - s), u2 = u * u;
        return norm_ * u2 * u2 * (1.0 + 4.0 * s);
    }
    template <class T>
    HEADRACE_ALWAYS_INLINE T F(const T& r) const {
        const T u = positive_or_zero(1.0 - r * inv_R_);
        return (slope_ * u) * (u * u);
    }
    // V_i V_j F(r). What does not depend on r or j is multiplied first: loops do that once.
    template <class T>
    HEADRACE_ALWAYS_INLINE T weighted_F(const T& r, const T& V_i, const T& V_j) const {
        const T u = positive_or_zero(1.0 - r * inv_R_);
        return (slope_ * V_i * V_j * u) * (u * u);
    }
    template <class T>
    HEADRACE_ALWAYS_INLINE T dF_dr(const T& r) const {
        const T u = positive_or_zero(1.0 - r * inv_R_);
        return -3.0 * inv_R_ * slope_ * u * u;
    }

  private:
    double inv_R_, norm_, slope_;
};

// Any of the kernels, chosen at run time: the others than the default are for comparison, and one instance of each
// loop serves them all. The branch is the same for a whole run.
template <int D>
class AnyKernel {
  public:
    AnyKernel(KernelKind kind, double R);

    template <class T>
    HEADRACE_ALWAYS_INLINE T W(const T& r) const {
        const T s = r * inv_R_;
        switch (kind_) {
            case KernelKind::wendland_c2: {
                const T u = positive_or_zero(1.0 - s), u2 = u * u;
                return norm_ * u2 * u2 * (1.0 + 4.0 * s);
            }
            case KernelKind::wendland_c4: {
                // N (1-s)^6 (1 + 6s + 35/3 s^2), N = 9/(pi R^2), 495/(32 pi R^3). Dehnen & Aly 2012, Table 1 (C4).
                const T u = positive_or_zero(1.0 - s), u2 = u * u;
                return norm_ * u2 * u2 * u2 * (1.0 + 6.0 * s + 35.0 / 3.0 * s * s);
            }
            case KernelKind::cubic_spline: {
                // N ((2-q)^3 - 4 (1-q)^3), q = 2s. Monaghan & Lattanzio 1985.
                const T a = positive_or_zero(2.0 - 2.0 * s), b = positive_or_zero(1.0 - 2.0 * s);
                return norm_ * (a * a * a - 4.0 * b * b * b);
            }
            case KernelKind::quintic_spline:
                break;
        }
        // N ((3-q)^5 - 6 (2-q)^5 + 15 (1-q)^5), q = 3s. Morris, Fox, Zhu 1997.
        const T q = 3.0 * s, a = positive_or_zero(3.0 - q), b = positive_or_zero(2.0 - q),
                c = positive_or_zero(1.0 - q);
        return norm_ * (a * a * a * a * a - 6.0 * b * b * b * b * b + 15.0 * c * c * c * c * c);
    }

    template <class T>
    HEADRACE_ALWAYS_INLINE T F(const T& r) const {
        const T s = r * inv_R_;
        switch (kind_) {
            case KernelKind::wendland_c2: {
                const T u = positive_or_zero(1.0 - s);
                return (slope_ * u) * (u * u);
            }
            case KernelKind::wendland_c4: {
                const T u = positive_or_zero(1.0 - s), u2 = u * u;
                return slope_ * u2 * u2 * u * (1.0 + 5.0 * s);
            }
            case KernelKind::cubic_spline: {
                const T q = 2.0 * s, a = positive_or_zero(2.0 - q), b = positive_or_zero(1.0 - q);
                return slope_ * (a * a - 4.0 * b * b) / maximum(q, splat<T>(kTiny));
            }
            case KernelKind::quintic_spline:
                break;
        }
        const T q = 3.0 * s, a = positive_or_zero(3.0 - q), b = positive_or_zero(2.0 - q),
                c = positive_or_zero(1.0 - q);
        return slope_ * (a * a * a * a - 6.0 * b * b * b * b + 15.0 * c * c * c * c) / maximum(q, splat<T>(kTiny));
    }

    template <class T>
    HEADRACE_ALWAYS_INLINE T dF_dr(const T& r) const {
        const T s = r * inv_R_;
        switch (kind_) {
            case KernelKind::wendland_c2: {
                const T u = positive_or_zero(1.0 - s);
                return -3.0 * inv_R_ * slope_ * u * u;
            }
            case KernelKind::wendland_c4: {
                const T u = positive_or_zero(1.0 - s), u2 = u * u;
                return -30.0 * inv_R_ * slope_ * s * u2 * u2;
            }
            case KernelKind::cubic_spline: {
                // F = P/q: dF/dq = (P' - F)/q
                const T q = 2.0 * s, a = positive_or_zero(2.0 - q), b = positive_or_zero(1.0 - q);
                return slope_ * 2.0 * inv_R_ *
                       ((8.0 * b - 2.0 * a) - (a * a - 4.0 * b * b) / maximum(q, splat<T>(kTiny))) /
                       maximum(q, splat<T>(kTiny));
            }
            case KernelKind::quintic_spline:
                break;
        }
        const T q = 3.0 * s, a = positive_or_zero(3.0 - q), b = positive_or_zero(2.0 - q),
                c = positive_or_zero(1.0 - q), inv_q = 1.0 / maximum(q, splat<T>(kTiny));
        const T a3 = a * a * a, b3 = b * b * b, c3 = c * c * c;
        return slope_ * 3.0 * inv_R_ * inv_q *
               (-4.0 * (a3 - 6.0 * b3 + 15.0 * c3) - inv_q * (a * a3 - 6.0 * b * b3 + 15.0 * c * c3));
    }

  private:
    static constexpr double kTiny = 1e-12;  // keeps 0/0 out where r = 0; the gradient is 0 there anyway

    KernelKind kind_;
    double inv_R_, norm_{}, slope_{};
};

template <int D>
AnyKernel<D>::AnyKernel(KernelKind kind, double R) : kind_(kind), inv_R_(1.0 / R) {
    constexpr double pi = std::numbers::pi;
    switch (kind) {
        case KernelKind::wendland_c2:
            norm_ = D == 2 ? 7.0 / (pi * R * R) : 21.0 / (2.0 * pi * R * R * R);
            slope_ = -20.0 * norm_ / (R * R);
            break;
        case KernelKind::wendland_c4:
            norm_ = D == 2 ? 9.0 / (pi * R * R) : 495.0 / (32.0 * pi * R * R * R);
            slope_ = -56.0 / 3.0 * norm_ / (R * R);
            break;
        case KernelKind::cubic_spline: {
            const double h = R / 2.0;
            norm_ = (D == 2 ? 10.0 / (7.0 * pi * h * h) : 1.0 / (pi * h * h * h)) / 4.0;
            slope_ = -3.0 * norm_ / (h * h);
            break;
        }
        case KernelKind::quintic_spline: {
            const double h = R / 3.0;
            norm_ = D == 2 ? 7.0 / (478.0 * pi * h * h) : 1.0 / (120.0 * pi * h * h * h);
            slope_ = -5.0 * norm_ / (h * h);
            break;
        }
    }
}

}  // namespace headrace::solver
