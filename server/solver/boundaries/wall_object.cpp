#include "server/solver/boundaries/wall_object.h"

#include <cmath>

#include "server/solver/boundaries/rigid_motion.h"

namespace headrace::solver {

WallObject::WallObject(const CollisionObject& object, const SamplingSpace& space, double t)
    : body_(make_body(object, space.domain, space.dimensions)), motion_(object.motion), space_(space) {
    if (motion_) state_ = motion_(t);
    const Plane* plane = std::get_if<Plane>(&body_.shape);
    for (int k = 0; k < space.dimensions; ++k) wraps_[k] = space.domain.periodic[k] && !plane;
    if (plane) {
        const std::vector<Repetition> repetitions = plane_repetitions(*plane, space);
        for (const Repetition& repetition : repetitions) {
            if (repetition.periodic_axis >= 0) wraps_[repetition.periodic_axis] = true;
        }
        if (motion_) repetitions_ = repetitions;
    }
    find_images();
    follow_domain();
}

WallObject::Change WallObject::move_to(double t) {
    if (!motion_) return {};
    const RigidState state = motion_(t);
    const Change change{!rigid::is_same_place(state, state_), !rigid::is_same_motion(state, state_)};
    state_ = state;
    if (change.of_place) follow_domain();
    return change;
}

// A body of at most half a period is seen best from the image nearest to its centre, and so is any box or sphere that
// does not turn. Larger ones are asked for each image.
void WallObject::find_images() {
    images_.clear();
    const bool is_plain = std::holds_alternative<Sphere>(body_.shape) || std::holds_alternative<Plane>(body_.shape) ||
                          (std::holds_alternative<Box>(body_.shape) && !motion_);
    if (is_plain) return;
    const double radius = bounding_radius(body_);
    std::array<int, 3> reach{};
    Vec3 period{};
    for (int k = 0; k < space_.dimensions; ++k) {
        period[k] = space_.domain.max[k] - space_.domain.min[k];
        if (wraps_[k] && !body_.endless[k] && radius > 0.25 * period[k]) reach[k] = 1;
    }
    for (int i = -reach[0]; i <= reach[0]; ++i) {
        for (int j = -reach[1]; j <= reach[1]; ++j) {
            for (int k = -reach[2]; k <= reach[2]; ++k) {
                if (i != 0 || j != 0 || k != 0) images_.push_back({i * period[0], j * period[1], k * period[2]});
            }
        }
    }
}

void WallObject::follow_domain() {
    center_ = to_world(center_of(body_.shape));
    middle_.clear();
    const Domain& domain = space_.domain;
    const Vec3 middle = to_body(rigid::times(0.5, rigid::plus(domain.min, domain.max)));
    for (const Repetition& repetition : repetitions_) middle_.push_back(rigid::dot(repetition.direction, middle));
}

Vec3 WallObject::nearest_image(const Vec3& x) const {
    Vec3 image = x;
    for (int k = 0; k < space_.dimensions; ++k) {
        if (!wraps_[k]) continue;
        const double period = space_.domain.max[k] - space_.domain.min[k];
        image[k] -= period * std::round((x[k] - center_[k]) / period);
    }
    return image;
}

SurfacePoint WallObject::surface(const Vec3& x, Vec3* image) const {
    const Vec3 first = nearest_image(x);
    Vec3 best_image = first;
    SurfacePoint best = nearest_surface(body_, to_body(first));
    for (const Vec3& displacement : images_) {
        const Vec3 other = rigid::plus(first, displacement);
        const SurfacePoint surface = nearest_surface(body_, to_body(other));
        // Fluid is what lies in one of the containers; solid what lies in one of the obstacles.
        if (body_.is_container ? surface.distance > best.distance : surface.distance < best.distance) {
            best = surface;
            best_image = other;
        }
    }
    if (image) *image = best_image;
    return {best.distance, turn(best.normal)};
}

bool WallObject::holds(const Vec3& x) const {
    return surface(x).distance < -1e-9 * space_.dx;
}

Vec3 WallObject::velocity(const Vec3& image, const Vec3& normal) const {
    const Vec3& belt = state_.surface_velocity;
    const Vec3 along = rigid::minus(belt, rigid::times(rigid::dot(belt, normal), normal));
    return rigid::plus(rigid::velocity(state_, image), along);
}

Vec3 WallObject::acceleration(const Vec3& image) const {
    return rigid::acceleration(state_, image);
}

Vec3 WallObject::place(const Dummy& dummy) const {
    Vec3 X = dummy.X;
    for (std::size_t k = 0; k < repetitions_.size(); ++k) {
        const Repetition& repetition = repetitions_[k];
        const double ahead = (middle_[k] - rigid::dot(repetition.direction, X)) / repetition.period;
        X = rigid::plus(X, rigid::times(repetition.period * std::round(ahead), repetition.direction));
    }
    return to_world(X);
}

bool WallObject::bring_into_domain(Vec3& x) const {
    const Domain& domain = space_.domain;
    for (int k = 0; k < space_.dimensions; ++k) {
        const double min = domain.min[k], max = domain.max[k];
        if (wraps_[k]) {
            x[k] -= (max - min) * std::floor((x[k] - min) / (max - min));
            if (x[k] >= max || x[k] < min) x[k] = min;  // round-off at the seam
        } else if (domain.periodic[k]) {
            if (!(x[k] >= min && x[k] < max)) return false;
        } else if (!(x[k] >= min - space_.depth && x[k] <= max + space_.depth)) {
            return false;
        }
    }
    return true;
}

Vec3 WallObject::to_body(const Vec3& x) const {
    return motion_ ? rigid::to_body(state_, x) : x;
}

Vec3 WallObject::to_world(const Vec3& X) const {
    return motion_ ? rigid::to_world(state_, X) : X;
}

Vec3 WallObject::turn(const Vec3& n) const {
    return motion_ ? rigid::rotate(state_, n) : n;
}

}  // namespace headrace::solver
