#include "server/at_rest.h"

#include <cmath>

#include "server/solver/diagnostics.h"

namespace headrace::server {

namespace {

// [m/s] factor * sqrt(|g| H), by the gravity of the moment. Without gravity there is no wave speed to compare with:
// 1 m/s takes its place.
double slow_speed(const scene::Run& run, double factor) {
    const solver::Vec3 gravity = run.model().gravity();
    const double g = std::hypot(gravity[0], gravity[1], gravity[2]);
    return factor * (g > 0.0 ? std::sqrt(g * run.fluid_height()) : 1.0);
}

}  // namespace

AtRestWatch::AtRestWatch(const scene::Run& run) : criterion_(run.scene().at_rest), watched_since_(run.time()) {}

bool AtRestWatch::update(const scene::Run& run) {
    const double slow = slow_speed(run, criterion_.speed_factor);
    // The largest speed comes with each step; a share has to be counted.
    const bool is_slow = criterion_.share >= 1.0
                             ? run.last_report().max_speed < slow
                             : solver::compute_slow_share(run.particles(), slow) >= criterion_.share;
    if (!is_slow) {
        slow_since_.reset();
        return false;
    }
    if (!slow_since_) slow_since_ = run.time();
    return run.time() - *slow_since_ >= criterion_.duration * (1.0 - 1e-9);
}

}  // namespace headrace::server
