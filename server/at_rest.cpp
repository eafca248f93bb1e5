#include "server/at_rest.h"

#include <cmath>

#include "server/solver/diagnostics.h"

namespace headrace::server {

AtRestWatch::AtRestWatch(const scene::Run& run) : criterion_(run.scene().at_rest) {
    const solver::Vec3 gravity = run.model().gravity();
    const double g = std::hypot(gravity[0], gravity[1], gravity[2]);
    // Without gravity there is no wave speed to compare with: 1 m/s takes its place.
    threshold_ = criterion_.speed_factor * (g > 0.0 ? std::sqrt(g * run.fluid_height()) : 1.0);
}

bool AtRestWatch::update(const scene::Run& run) {
    // The largest speed comes with each step; a share has to be counted.
    const bool is_slow = criterion_.share >= 1.0
                             ? run.last_report().max_speed < threshold_
                             : solver::compute_slow_share(run.particles(), threshold_) >= criterion_.share;
    if (!is_slow) {
        slow_since_.reset();
        return false;
    }
    if (!slow_since_) slow_since_ = run.time();
    return run.time() - *slow_since_ >= criterion_.duration * (1.0 - 1e-9);
}

}  // namespace headrace::server
