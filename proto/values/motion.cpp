#include "proto/values/motion.h"

#include <algorithm>
#include <cmath>

namespace headrace::scene {

using proto::Error;
using proto::ErrorCode;
using proto::Result;
using proto::Vec3;

namespace {

bool is_finite_vector(const Vec3& v) {
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

}  // namespace

Rotation rotation(double angle, const Vec3& n) {
    const double c = std::cos(angle), s = std::sin(angle), d = 1.0 - c;
    return {c + n[0] * n[0] * d,        n[0] * n[1] * d - n[2] * s, n[0] * n[2] * d + n[1] * s,
            n[1] * n[0] * d + n[2] * s, c + n[1] * n[1] * d,        n[1] * n[2] * d - n[0] * s,
            n[2] * n[0] * d - n[1] * s, n[2] * n[1] * d + n[0] * s, c + n[2] * n[2] * d};
}

bool Placement::is_finite() const {
    return is_finite_vector(pivot) && is_finite_vector(translation) &&
           std::ranges::all_of(turn, [](double entry) { return std::isfinite(entry); });
}

Vec3 Placement::operator()(const Vec3& X) const {
    const Vec3 arm = turned({X[0] - pivot[0], X[1] - pivot[1], X[2] - pivot[2]});
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = pivot[k] + translation[k] + arm[k];
    return x;
}

Vec3 Placement::turned(const Vec3& a) const {
    const Rotation& R = turn;
    return {R[0] * a[0] + R[1] * a[1] + R[2] * a[2], R[3] * a[0] + R[4] * a[1] + R[5] * a[2],
            R[6] * a[0] + R[7] * a[1] + R[8] * a[2]};
}

Result<Motion> Motion::make(const proto::MotionDesc& desc, int dimensions, double spacing, const std::string& path) {
    Motion motion;
    if (desc.displacement) {
        auto curves = make_curves(*desc.displacement, dimensions, spacing, path + ".displacement");
        if (!curves) return curves.error();
        motion.displacement = std::move(*curves);
    }
    if (desc.angle) {
        auto curve = make_curve(*desc.angle, spacing, path + ".angle");
        if (!curve) return curve.error();
        motion.angle = std::move(*curve);
    }
    motion.pivot = desc.pivot;
    if (dimensions == 3) {
        const double length = std::hypot(desc.axis[0], desc.axis[1], desc.axis[2]);
        if (!(length > 0.0) || !std::isfinite(length))
            return Error{ErrorCode::scene_invalid, "must be finite and not zero", path + ".axis",
                         "give a direction, of any length"};
        for (int k = 0; k < 3; ++k) motion.axis[k] = 1.0 / length * desc.axis[k];
    }
    if (!is_finite_vector(desc.pivot))
        return Error{ErrorCode::scene_invalid, "must be finite", path + ".pivot", "give lengths in m"};
    return motion;
}

Placement Motion::at(double t) const {
    Placement placement;
    placement.pivot = pivot;
    for (int k = 0; k < 3; ++k) placement.translation[k] = displacement[k].value(t);
    if (angle) placement.turn = rotation(angle->value(t), axis);
    return placement;
}

Result<MovingObjects> MovingObjects::make(const std::vector<proto::ObjectDesc>& objects, int dimensions,
                                          double spacing) {
    MovingObjects moving;
    for (std::size_t k = 0; k < objects.size(); ++k) {
        std::optional<Motion>& motion = moving.motions_.emplace_back();
        if (!objects[k].motion) continue;
        auto made = Motion::make(*objects[k].motion, dimensions, spacing, "objects[" + std::to_string(k) + "].motion");
        if (!made) return made.error();
        motion = *std::move(made);
    }
    return moving;
}

std::vector<Placement> MovingObjects::at(double t) const {
    std::vector<Placement> placements(motions_.size());
    for (std::size_t k = 0; k < motions_.size(); ++k) {
        if (!motions_[k]) continue;
        const Placement placement = motions_[k]->at(t);
        if (placement.is_finite()) placements[k] = placement;
    }
    return placements;
}

}  // namespace headrace::scene
