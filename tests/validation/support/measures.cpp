#include "tests/validation/support/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace headrace::validation {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Solves the symmetric system in place by Gaussian elimination with pivoting; false when it is singular.
template <std::size_t N>
bool solve(std::array<std::array<double, N>, N> a, std::array<double, N>& b) {
    for (std::size_t c = 0; c < N; ++c) {
        std::size_t pivot = c;
        for (std::size_t r = c; r < N; ++r)
            if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
        if (std::abs(a[pivot][c]) < 1e-300) return false;
        std::swap(a[pivot], a[c]);
        std::swap(b[pivot], b[c]);
        for (std::size_t r = c + 1; r < N; ++r) {
            const double factor = a[r][c] / a[c][c];
            for (std::size_t k = c; k < N; ++k) a[r][k] -= factor * a[c][k];
            b[r] -= factor * b[c];
        }
    }
    for (std::size_t c = N; c-- > 0;) {
        for (std::size_t k = c + 1; k < N; ++k) b[c] -= a[c][k] * b[k];
        b[c] /= a[c][c];
    }
    return true;
}

}  // namespace

double semi_axis(const solver::Particles& particles, int axis) {
    double mass = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        mass += particles.m[i];
        moment += particles.m[i] * particles.x[axis][i] * particles.x[axis][i];
    }
    return std::sqrt(4 * moment / mass);
}

double kinetic_energy(const solver::Particles& particles) {
    double energy = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        for (int k = 0; k < particles.dimensions; ++k)
            energy += particles.m[i] * particles.v[k][i] * particles.v[k][i] / 2;
    return energy;
}

double surface_mode(const solver::Particles& particles, double k, double L) {
    double sum = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        sum += particles.m[i] / particles.rho[i] * std::cos(k * particles.x[0][i]);
    return 2 * sum / L;
}

double Series::half_range(double from, double to) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < t.size(); ++i) {
        if (t[i] < from || t[i] > to) continue;
        low = std::min(low, value[i]);
        high = std::max(high, value[i]);
    }
    return high >= low ? (high - low) / 2 : kNone;
}

double Series::integral(double from, double to) const {
    double sum = 0.0;
    for (std::size_t i = 1; i < t.size(); ++i) {
        const double a = std::max(from, t[i - 1]), b = std::min(to, t[i]);
        if (b <= a) continue;
        const double slope = (value[i] - value[i - 1]) / (t[i] - t[i - 1]);
        sum += (b - a) * (value[i - 1] + slope * ((a + b) / 2 - t[i - 1]));
    }
    return sum;
}

double DampedWave::amplitude(double t) const {
    return std::exp(-rate * t) * std::hypot(A, B);
}

// Gauss-Newton in (rate, omega, A, B, offset); the first step, linear in A, B and offset, finds those.
DampedWave fit_damped_wave(const Series& series, double from, double omega_guess, double rate_guess) {
    DampedWave wave{rate_guess, omega_guess, 0.0, 0.0, 0.0};
    for (int iteration = 0; iteration < 60; ++iteration) {
        const bool is_linear = iteration == 0;
        std::array<std::array<double, 5>, 5> normal{};
        std::array<double, 5> change{};
        for (std::size_t i = 0; i < series.t.size(); ++i) {
            const double t = series.t[i];
            if (t < from) continue;
            const double decay = std::exp(-wave.rate * t), c = std::cos(wave.omega * t), s = std::sin(wave.omega * t);
            const double model = decay * (wave.A * c + wave.B * s);
            const double turning = decay * t * (wave.B * c - wave.A * s);
            const std::array<double, 5> slope{is_linear ? 0.0 : -t * model, is_linear ? 0.0 : turning, decay * c,
                                              decay * s, 1.0};
            const double rest = series.value[i] - model - wave.offset;
            for (std::size_t r = 0; r < 5; ++r) {
                change[r] += slope[r] * rest;
                for (std::size_t k = 0; k < 5; ++k) normal[r][k] += slope[r] * slope[k];
            }
        }
        if (is_linear) normal[0][0] = normal[1][1] = 1.0;
        if (!solve(normal, change)) return {kNone, kNone, kNone, kNone, kNone};
        wave.rate += change[0];
        wave.omega += change[1];
        wave.A += change[2];
        wave.B += change[3];
        wave.offset += change[4];
        if (!is_linear && std::abs(change[1]) < 1e-12 * omega_guess && std::abs(change[0]) < 1e-12 * omega_guess) break;
    }
    return wave;
}

std::vector<double> interpolate(const solver::Particles& particles, const std::vector<double>& field,
                                const std::vector<solver::Vec3>& points, double reach) {
    std::vector<double> values;
    for (const solver::Vec3& point : points) {
        std::array<std::array<double, 3>, 3> normal{};
        std::array<double, 3> b{};
        int count = 0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const double x = particles.x[0][i] - point[0], y = particles.x[1][i] - point[1];
            const double q = std::hypot(x, y) / reach;
            if (q >= 1.0) continue;
            const double weight = std::pow(1 - q, 4) * (1 + 4 * q);
            const std::array<double, 3> basis{1.0, x / reach, y / reach};
            for (std::size_t r = 0; r < 3; ++r) {
                b[r] += weight * basis[r] * field[i];
                for (std::size_t k = 0; k < 3; ++k) normal[r][k] += weight * basis[r] * basis[k];
            }
            ++count;
        }
        values.push_back(count >= 3 && solve(normal, b) ? b[0] : kNone);
    }
    return values;
}

}  // namespace headrace::validation
