#include "tests/validation/exact/flows.h"

#include <cmath>
#include <numbers>

namespace headrace::exact {

namespace {
constexpr double kPi = std::numbers::pi;
constexpr double kGamma = 7.0;  // Tait's exponent for water
constexpr int kTerms = 400;     // of the series: exact to 1e-15 for nu t / L^2 > 3e-4
}  // namespace

Flow2D taylor_green(double x, double y, double t, double U, double L, double nu, double rho) {
    const double k = 2 * kPi / L;
    const double decay = std::exp(-2 * k * k * nu * t);
    return {-U * decay * std::cos(k * x) * std::sin(k * y), U * decay * std::sin(k * x) * std::cos(k * y),
            -rho * U * U / 4 * decay * decay * (std::cos(2 * k * x) + std::cos(2 * k * y))};
}

double couette(double y, double t, double V0, double L, double nu) {
    double u = V0 * y / L;
    for (int n = 1; n < kTerms; ++n) {
        const double k = n * kPi / L;
        u += 2 * V0 / (n * kPi) * (n % 2 == 0 ? 1.0 : -1.0) * std::sin(k * y) * std::exp(-nu * k * k * t);
    }
    return u;
}

double poiseuille(double y, double t, double F, double L, double nu) {
    double u = F / (2 * nu) * y * (L - y);
    for (int n = 1; n < kTerms; n += 2) {
        const double k = n * kPi / L;
        u -= 4 * F * L * L / (nu * std::pow(n * kPi, 3)) * std::sin(k * y) * std::exp(-nu * k * k * t);
    }
    return u;
}

// dp = rho g d(depth) with p(rho) of the state equation.
double StillColumn::density(double depth) const {
    if (!tait) return rho0 * std::exp(g * depth / (c0 * c0));
    return rho0 * std::pow(1 + (kGamma - 1) * g * depth / (c0 * c0), 1 / (kGamma - 1));
}

double StillColumn::pressure(double depth) const {
    const double ratio = density(depth) / rho0;
    return tait ? rho0 * c0 * c0 / kGamma * (std::pow(ratio, kGamma) - 1) : rho0 * c0 * c0 * (ratio - 1);
}

// The bottom carries load g: invert pressure(depth) = load g.
double StillColumn::depth_of(double load) const {
    const double p = load * g / (rho0 * c0 * c0);
    if (!tait) return c0 * c0 / g * std::log1p(p);
    return c0 * c0 / (g * (kGamma - 1)) * (std::pow(1 + kGamma * p, (kGamma - 1) / kGamma) - 1);
}

}  // namespace headrace::exact
