#include "server/solver/models/wcsph/health.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

double square_of(const VectorField& field, int dimensions, std::size_t i) {
    double sum = 0.0;
    for (int k = 0; k < dimensions; ++k) sum += field[k][i] * field[k][i];
    return sum;
}

Vec3 vector_of(const VectorField& field, int dimensions, std::size_t i) {
    Vec3 u{};
    for (int k = 0; k < dimensions; ++k) u[k] = field[k][i];
    return u;
}

struct Largest {
    double value{-1.0};
    std::size_t slot{};

    void take(double other, std::size_t i) {
        if (other > value) *this = {other, i};
    }
};

struct Found {
    Largest acceleration2, speed2, deviation;
};

Largest larger(const Largest& a, const Largest& b) {
    return b.value > a.value ? b : a;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

// The part of the advice that concerns the length of the steps; empty when it is as it should be.
std::string step_advice(const RunLimits& limits) {
    if (limits.fixed_step > limits.acoustic_step)
        return "set time_step to 0, so that the criteria choose it, or below " + number(limits.acoustic_step) + " s; ";
    if (limits.cfl > limits.recommended_cfl)
        return "reduce cfl from " + number(limits.cfl) + " to " + number(limits.recommended_cfl) + "; ";
    return {};
}

std::string gradient_advice(const RunLimits& limits) {
    if (!limits.is_confined) return {};
    return "where the fluid has a free surface, set free_surface to true and pressure_gradient to automatic; ";
}

std::string shifting_advice(const RunLimits& limits) {
    return limits.shifts ? "" : "set shifting to true: without it particles pile up; ";
}

std::string stiffness_advice(const RunLimits& limits) {
    if (limits.sound_speed_by_rule)
        return "set reference_speed to the largest speed expected: the fluid was made for a tenth of c0 = " +
               number(limits.sound_speed) + " m/s";
    return "raise sound_speed, now " + number(limits.sound_speed) + " m/s, to ten times the largest speed expected";
}

}  // namespace

Extremes find_extremes(const Particles& particles, const std::vector<double>& delta) {
    const int dimensions = particles.dimensions;
    const Found found = parallel_reduce(
        particles.size(), Found{},
        [&](std::size_t begin, std::size_t end) {
            Found block;
            for (std::size_t i = begin; i < end; ++i) {
                block.acceleration2.take(square_of(particles.a, dimensions, i), i);
                block.speed2.take(square_of(particles.v, dimensions, i), i);
                const double deviation = std::abs(delta[i]);
                block.deviation.take(std::isnan(deviation) ? std::numeric_limits<double>::infinity() : deviation, i);
            }
            return block;
        },
        [](const Found& a, const Found& b) {
            return Found{larger(a.acceleration2, b.acceleration2), larger(a.speed2, b.speed2),
                         larger(a.deviation, b.deviation)};
        });
    return {std::sqrt(std::max(found.acceleration2.value, 0.0)), found.acceleration2.slot,
            std::max(found.deviation.value, 0.0), found.deviation.slot, found.speed2.slot};
}

std::string remedy_for(FaultKind kind, const RunLimits& limits) {
    const std::string advice = step_advice(limits);
    switch (kind) {
        case FaultKind::left_domain:
            return advice.empty() ? "enlarge the domain, or keep the fluid in by an object of role container"
                                  : advice + "else enlarge the domain";
        case FaultKind::density:
            return advice + gradient_advice(limits) + shifting_advice(limits) + stiffness_advice(limits) +
                   "; look for fluids that overlap or an object put into fluid";
        case FaultKind::speed:
            return advice + shifting_advice(limits) + stiffness_advice(limits);
        case FaultKind::time_step:
            return advice + "the criterion \"" + std::string(limits.limit) + "\" leaves steps of " +
                   number(limits.next_step) +
                   " s: look for gravity, body_force, viscosity, surface_tension, sound_speed or cfl out of "
                   "proportion, "
                   "fluids that overlap, an object put into fluid";
        case FaultKind::non_finite:
            break;
    }
    return advice + "check body_force and the motions of objects for values without bound; " + stiffness_advice(limits);
}

std::optional<Fault> check_health(const Particles& particles, const Extremes& extremes, const RunLimits& limits) {
    const auto fault = [&](FaultKind kind, std::size_t i) {
        return Fault{kind, particles.id[i], vector_of(particles.x, particles.dimensions, i),
                     vector_of(particles.v, particles.dimensions, i), remedy_for(kind, limits)};
    };
    if (particles.size() == 0) return std::nullopt;
    if (extremes.max_deviation > kMostDeviation) return fault(FaultKind::density, extremes.most_deviating);
    const double speed = std::sqrt(square_of(particles.v, particles.dimensions, extremes.fastest));
    if (speed > kMostMach * limits.sound_speed) return fault(FaultKind::speed, extremes.fastest);
    // Viscosity, tension and a fixed step are chosen by the scene, however short.
    const bool is_chosen = limits.limit != "advective" && limits.limit != "body force";
    if (!is_chosen && limits.next_step < kLeastStep * limits.acoustic_step)
        return fault(FaultKind::time_step, extremes.fastest_changing);
    if (limits.next_step < kLeastSeconds) return fault(FaultKind::time_step, extremes.fastest_changing);
    return std::nullopt;
}

}  // namespace headrace::solver
