#include "server/probes/interpolation.h"

#include <array>
#include <optional>
#include <utility>

namespace headrace::probes {

namespace {

double distance(int dimensions, const Vec3& x, const Vec3& y) {
    double r2 = 0.0;
    for (int k = 0; k < dimensions; ++k) r2 += (x[k] - y[k]) * (x[k] - y[k]);
    return std::sqrt(r2);
}

using Matrix = std::array<Vec3, 3>;

// C^-1 s for a positive definite C by Cholesky's decomposition; nothing when C is singular.
std::optional<Vec3> solve(const Matrix& C, const Vec3& s, int n) {
    constexpr double kSmallest = 1e-10;  // [1] variance in units of R^2: a row of particles that rounding has bent
    Matrix L{};
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) {
            double rest = C[i][j];
            for (int k = 0; k < j; ++k) rest -= L[i][k] * L[j][k];
            if (i == j && !(rest > kSmallest)) return std::nullopt;
            L[i][j] = i == j ? std::sqrt(rest) : rest / L[j][j];
        }
    Vec3 y{}, x{};
    for (int i = 0; i < n; ++i) {
        y[i] = s[i];
        for (int k = 0; k < i; ++k) y[i] -= L[i][k] * y[k];
        y[i] /= L[i][i];
    }
    for (int i = n - 1; i >= 0; --i) {
        x[i] = y[i];
        for (int k = i + 1; k < n; ++k) x[i] -= L[k][i] * x[k];
        x[i] /= L[i][i];
    }
    return x;
}

}  // namespace

double concentration(int dimensions, double R, const Vec3& x, std::span<const NearParticle> near) {
    double sum = 0.0;
    for (const NearParticle& j : near) sum += j.V * wendland_c2(dimensions, R, distance(dimensions, j.x, x));
    return sum;
}

bool make_weights(int dimensions, double R, const Vec3& x, std::span<const NearParticle> near,
                  std::vector<double>& weights) {
    weights.assign(near.size(), 0.0);
    double sum = 0.0;
    for (std::size_t j = 0; j < near.size(); ++j) {
        weights[j] = near[j].V * wendland_c2(dimensions, R, distance(dimensions, near[j].x, x));
        sum += weights[j];
    }
    if (!(sum > 0.0)) return weights.clear(), false;
    for (double& w : weights) w /= sum;

    Vec3 s{};
    Matrix C{};
    const auto d = [&](std::size_t j, int k) { return (near[j].x[k] - x[k]) / R; };
    for (std::size_t j = 0; j < near.size(); ++j)
        for (int k = 0; k < dimensions; ++k) s[k] += weights[j] * d(j, k);
    // About the mean, so that nothing cancels.
    for (std::size_t j = 0; j < near.size(); ++j)
        for (int k = 0; k < dimensions; ++k)
            for (int l = 0; l <= k; ++l) C[k][l] += weights[j] * (d(j, k) - s[k]) * (d(j, l) - s[l]);

    const auto c = solve(C, s, dimensions);
    if (!c) return true;
    std::vector<double> corrected(near.size());
    double amplification = 0.0;
    for (std::size_t j = 0; j < near.size(); ++j) {
        double correction = 0.0;
        for (int k = 0; k < dimensions; ++k) correction += (*c)[k] * (d(j, k) - s[k]);
        corrected[j] = weights[j] * (1.0 - correction);
        amplification += std::abs(corrected[j]);
    }
    if (amplification <= kMostAmplification) weights = std::move(corrected);
    return true;
}

}  // namespace headrace::probes
