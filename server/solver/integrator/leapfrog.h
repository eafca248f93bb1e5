// Leap-frog, Staubach 2010, Eq. 2.33-2.36, one component at a time. The carried velocity v_half stands half a step
// behind x.
#pragma once

namespace headrace::solver {

// v_{-dt/2} = v_0 - dt/2 a_0 (2.35)
inline double leap_start(double v_0, double a_0, double dt) {
    return v_0 - 0.5 * dt * a_0;
}

// v_{t+dt/2} = v_{t-dt/2} + dt a_t (2.33). Differs from 2.33 when the step changes: from t - dt_before/2 to t + dt/2
// it is (dt_before + dt)/2, which keeps the second order.
inline double leap_velocity(double v_half, double a, double dt_before, double dt) {
    return v_half + 0.5 * (dt_before + dt) * a;
}

// x_{t+dt} = x_t + dt v_{t+dt/2} (2.34)
inline double leap_position(double x, double v_half, double dt) {
    return x + dt * v_half;
}

// v_t = (v_{t-dt/2} + v_{t+dt/2})/2 (2.36)
inline double mean_velocity(double v_before, double v_after) {
    return 0.5 * (v_before + v_after);
}

}  // namespace headrace::solver
