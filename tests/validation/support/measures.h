// Sums and fits that turn particles and time series into errors.
#pragma once

#include <cstddef>
#include <vector>

#include "server/solver/particles.h"

namespace headrace::validation {

// sqrt(4 <x^2>) about the origin: the semi-axis of a uniform ellipse along the axis [m]. No surface is looked for.
double semi_axis(const solver::Particles& particles, int axis);

double kinetic_energy(const solver::Particles& particles);  // [J] (2D: J/m)

// (2/L) sum V cos(k x), V = m/rho: the cosine amplitude of the fluid's upper surface [m], exactly so for a fluid that
// fills the space between a flat bottom and the surface. 2D, L [m] a whole number of wavelengths.
double surface_mode(const solver::Particles& particles, double k, double L);

struct Series {
    std::vector<double> t;
    std::vector<double> value;

    void add(double time, double v) {
        t.push_back(time);
        value.push_back(v);
    }
    // Half of largest minus smallest within [from, to].
    double half_range(double from, double to) const;
    // Integral of f(t) dt by the trapezoidal rule over [from, to].
    double integral(double from, double to) const;
};

// exp(-rate t) (A cos(omega t) + B sin(omega t)) + offset by least squares over the samples from `from` on.
struct DampedWave {
    double rate{};   // [1/s]
    double omega{};  // [rad/s]
    double A{}, B{}, offset{};

    double amplitude(double t) const;
};
DampedWave fit_damped_wave(const Series& series, double from, double omega_guess, double rate_guess);

// Value of `field` at points by a first-order consistent (moving least squares, linear) interpolation over the
// particles within `reach` [m], weights Wendland C2. 2D. NaN where fewer than three particles are in reach.
std::vector<double> interpolate(const solver::Particles& particles, const std::vector<double>& field,
                                const std::vector<solver::Vec3>& points, double reach);

}  // namespace headrace::validation
