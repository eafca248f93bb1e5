#include "tests/validation/exact/drop.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace headrace::exact {

namespace {

Ellipse rate(const Ellipse& e, double B) {
    const double a2 = e.a * e.a, b2 = e.b * e.b;
    return {(e.s * e.s + B * B) * (b2 - a2) / (a2 + b2), e.s * e.a, -e.s * e.b};
}

Ellipse moved(const Ellipse& e, double dt, const Ellipse& d) {
    return {e.s + dt * d.s, e.a + dt * d.a, e.b + dt * d.b};
}

// Classical Runge-Kutta step of fourth order.
Ellipse advanced(const Ellipse& e, double dt, double B) {
    const Ellipse k1 = rate(e, B), k2 = rate(moved(e, dt / 2, k1), B), k3 = rate(moved(e, dt / 2, k2), B),
                  k4 = rate(moved(e, dt, k3), B);
    return {e.s + dt / 6 * (k1.s + 2 * k2.s + 2 * k3.s + k4.s), e.a + dt / 6 * (k1.a + 2 * k2.a + 2 * k3.a + k4.a),
            e.b + dt / 6 * (k1.b + 2 * k2.b + 2 * k3.b + k4.b)};
}

}  // namespace

// 0.002 of the shorter time scale: the fourth-order error of a period is then about 1e-11.
EllipticalDrop::EllipticalDrop(double s0, double B, double R)
    : s0_(s0), B_(B), R_(R), step_(0.002 / std::max(std::abs(s0), B)), state_{s0, R, R} {}

Ellipse EllipticalDrop::at(double t) {
    if (t < t_) {
        t_ = 0.0;
        state_ = {s0_, R_, R_};
    }
    while (t - t_ > step_) {
        state_ = advanced(state_, step_, B_);
        t_ += step_;
    }
    return advanced(state_, t - t_, B_);
}

double EllipticalDrop::energy(double t, double rho) {
    const Ellipse e = at(t);
    return std::numbers::pi / 8 * rho * e.a * e.b * (e.a * e.a + e.b * e.b) * (e.s * e.s + B_ * B_);
}

// After half a period a passes R inwards, after a whole one outwards.
double EllipticalDrop::period() const {
    EllipticalDrop drop(s0_, B_, R_);
    const double sign = s0_ > 0.0 ? 1.0 : -1.0;
    double t = 10 * drop.step_;
    const auto is_beyond = [&](double time) { return sign * (drop.at(time).a - R_) > 0.0; };
    while (is_beyond(t)) t += drop.step_;
    while (!is_beyond(t)) t += drop.step_;
    double low = t - drop.step_, high = t;
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (is_beyond(middle) ? high : low) = middle;
    }
    return (low + high) / 2;
}

double drop_centre_pressure(const Ellipse& e, double B, double rho) {
    const double a2 = e.a * e.a, b2 = e.b * e.b;
    return rho * (e.s * e.s + B * B) * a2 * b2 / (a2 + b2);
}

}  // namespace headrace::exact
