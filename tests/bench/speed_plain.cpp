#include "tests/bench/speed_plain.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "server/solver/parallel.h"

namespace headrace::bench {

namespace {

constexpr double kSpacing = 0.01;     // [m]
constexpr double kSoundSpeed = 10.0;  // [m/s]
constexpr double kMach = 0.1;         // largest speed over that of sound
constexpr double kMeanDelta = 0.02;   // several times what the flow takes away: rho U^2 is 0.01 of rho c^2
constexpr double kJitter = 0.2;       // displacement to each side in spacings
constexpr double kCourant = 0.4;      // on h = R/2
constexpr unsigned kSeed = 4100;

solver::Vec3 vortex(int dimensions, const solver::Vec3& x, double wave_number, double speed) {
    std::array<double, 3> s, c;
    for (int k = 0; k < 3; ++k) {
        s[k] = std::sin(wave_number * x[k]);
        c[k] = std::cos(wave_number * x[k]);
    }
    if (dimensions == 2) return {speed * s[0] * c[1], -speed * c[0] * s[1], 0.0};
    const double share = speed / std::sqrt(6.0);  // |v| is at most sqrt(6) of a coefficient
    return {share * (s[2] + c[1]), share * (s[0] + c[2]), share * (s[1] + c[0])};
}

template <class Body>
void for_blocks(const PlainFluid& fluid, Body&& body) {
    solver::parallel_for(fluid.size(), solver::kParticleBlock,
                         [&](std::size_t begin, std::size_t end, int) { body(begin, end); });
}

}  // namespace

PlainFluid make_plain_fluid(int dimensions, int edge, double support_over_dp, int waves) {
    PlainFluid fluid;
    fluid.dimensions = dimensions;
    fluid.spacing = kSpacing;
    fluid.support = support_over_dp * kSpacing;
    fluid.sound_speed = kSoundSpeed;
    fluid.dt = kCourant * 0.5 * fluid.support / (kSoundSpeed * (1.0 + kMach));
    const double length = edge * kSpacing;
    const auto count = static_cast<std::size_t>(std::lround(std::pow(edge, dimensions)));
    fluid.id.resize(count);
    std::iota(fluid.id.begin(), fluid.id.end(), solver::Index{0});
    for (int k = 0; k < dimensions; ++k) {
        fluid.domain.max[k] = length;
        fluid.domain.periodic[k] = true;
        for (solver::VectorField* field : {&fluid.x, &fluid.v_half}) (*field)[k].resize(count);
        fluid.a[k].resize(count);
    }
    fluid.delta_half.assign(count, kMeanDelta);
    fluid.delta_rate.resize(count);
    fluid.V.assign(count, static_cast<float>(std::pow(kSpacing, dimensions)));
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> uniform(-kJitter, kJitter);
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t rest = i;
        solver::Vec3 x{};
        for (int k = 0; k < dimensions; ++k, rest /= static_cast<std::size_t>(edge)) {
            const auto place = static_cast<double>(rest % static_cast<std::size_t>(edge));
            x[k] = fluid.x[k][i] = (place + 0.5 + uniform(random)) * kSpacing;
        }
        const solver::Vec3 v = vortex(dimensions, x, 2.0 * std::numbers::pi * waves / length, kMach * kSoundSpeed);
        for (int k = 0; k < dimensions; ++k) fluid.v_half[k][i] = v[k];
    }
    return fluid;
}

void start_plain_fluid(PlainFluid& fluid) {
    const double half = 0.5 * fluid.dt;
    for_blocks(fluid, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (int k = 0; k < fluid.dimensions; ++k) fluid.v_half[k][i] -= half * static_cast<double>(fluid.a[k][i]);
            fluid.delta_half[i] -= half * static_cast<double>(fluid.delta_rate[i]);
        }
    });
}

void advance_plain_fluid(PlainFluid& fluid) {
    const double dt = fluid.dt, half = 0.5 * dt;
    const double mass = std::pow(fluid.spacing, fluid.dimensions) * (1.0 + kMeanDelta);  // over rho0
    for_blocks(fluid, [&](std::size_t begin, std::size_t end) {
        for (int k = 0; k < fluid.dimensions; ++k) {
            double *x = fluid.x[k].data(), *v_half = fluid.v_half[k].data();
            const float* a = fluid.a[k].data();
            for (std::size_t i = begin; i < end; ++i) {
                v_half[i] += dt * static_cast<double>(a[i]);
                x[i] += dt * v_half[i];
            }
        }
        for (std::size_t i = begin; i < end; ++i) {
            const double rate = fluid.delta_rate[i];
            fluid.delta_half[i] += dt * rate;
            fluid.V[i] = static_cast<float>(mass / (1.0 + fluid.delta_half[i] + half * rate));
        }
    });
}

void wrap_plain_fluid(PlainFluid& fluid) {
    for_blocks(fluid, [&](std::size_t begin, std::size_t end) {
        for (int k = 0; k < fluid.dimensions; ++k) {
            const double length = fluid.domain.max[k];
            for (std::size_t i = begin; i < end; ++i) {
                double& x = fluid.x[k][i];
                if (x >= 0.0 && x < length) continue;
                x -= length * std::floor(x / length);
                if (!(x < length)) x = 0.0;
            }
        }
    });
}

}  // namespace headrace::bench
