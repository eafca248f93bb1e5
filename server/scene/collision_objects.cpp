#include "server/scene/collision_objects.h"

#include <cmath>

#include "proto/values/motion.h"
#include "server/scene/shapes.h"
#include "server/scene/vectors.h"
#include "server/solver/boundaries/primitives.h"

namespace headrace::scene {

using proto::Error;
using proto::ErrorCode;
using proto::Result;
using proto::Vec3;

namespace {

// The object's motion with what the walls want of it besides: rates, and how its surface slides.
struct WallMotion {
    Motion motion;
    std::array<Curve, 3> surface_velocity;  // [m/s]

    solver::RigidState operator()(double t) const {
        solver::RigidState state;
        state.pivot = motion.pivot;
        for (int k = 0; k < 3; ++k) {
            const CurvePoint point = motion.displacement[k].at(t);
            state.translation[k] = point.value;
            state.velocity[k] = point.rate;
            state.acceleration[k] = point.acceleration;
            state.surface_velocity[k] = surface_velocity[k].value(t);
        }
        if (!motion.angle) return state;
        const CurvePoint turn = motion.angle->at(t);
        state.rotation = rotation(turn.value, motion.axis);
        state.angular_velocity = scaled(turn.rate, motion.axis);
        state.angular_acceleration = scaled(turn.acceleration, motion.axis);
        return state;
    }
};

// What of the motion is bad at t = 0, as the member's name; nothing when it is finite.
std::optional<std::string> find_bad_start(const WallMotion& motion) {
    const solver::RigidState state = motion(0.0);
    const auto is_finite = [](const Vec3& v) { return std::isfinite(v[0] + v[1] + v[2]); };
    if (!is_finite(state.translation) || !is_finite(state.velocity) || !is_finite(state.acceleration))
        return ".motion.displacement";
    const double turn = state.rotation[0] + state.rotation[4] + state.rotation[8];
    if (!std::isfinite(turn) || !is_finite(state.angular_velocity) || !is_finite(state.angular_acceleration))
        return ".motion.angle";
    if (!is_finite(state.surface_velocity)) return ".surface_velocity";
    return {};
}

Result<WallMotion> make_motion(const proto::ObjectDesc& object, int dimensions, double spacing,
                               const std::string& path) {
    WallMotion motion;
    if (object.motion) {
        auto made = Motion::make(*object.motion, dimensions, spacing, path + ".motion");
        if (!made) return made.error();
        motion.motion = *std::move(made);
    }
    if (object.surface_velocity) {
        auto curves = make_curves(*object.surface_velocity, dimensions, spacing, path + ".surface_velocity");
        if (!curves) return curves.error();
        motion.surface_velocity = std::move(*curves);
    }
    if (const auto member = find_bad_start(motion))
        return Error{ErrorCode::scene_invalid, "the motion or one of its first two derivatives is not finite at t = 0",
                     path + *member, "the expression must be finite and smooth about t = 0, also a little before it"};
    return motion;
}

}  // namespace

Result<solver::CollisionObject> make_collision_object(const proto::ObjectDesc& object, int dimensions, double spacing,
                                                      const std::string& path) {
    solver::CollisionObject collision;
    collision.name = object.name;
    collision.role = object.role == proto::ObjectRole::container ? solver::Role::container : solver::Role::obstacle;
    collision.shape = to_primitive(object.shape, dimensions);
    if (object.slip)
        collision.slip = *object.slip == proto::WallSlip::free_slip ? solver::Slip::free_slip : solver::Slip::no_slip;
    if (object.motion || object.surface_velocity) {
        Result<WallMotion> motion = make_motion(object, dimensions, spacing, path);
        if (!motion) return motion.error();
        collision.motion = std::move(*motion);
        collision.is_belt = !object.motion;
    }
    return collision;
}

proto::Status check_turn(const proto::ObjectDesc& object, const solver::CollisionObject& collision,
                         const solver::Domain& domain, int dimensions, const std::string& path) {
    if (!object.motion || !object.motion->angle) return proto::Done{};
    constexpr double kParallel = 1e-12;  // [1] as the walls take it
    const Vec3 axis = dimensions == 2 ? Vec3{0.0, 0.0, 1.0} : normalized(object.motion->axis);
    const solver::Body body = solver::make_body(collision, domain, dimensions);
    const auto* plane = std::get_if<solver::Plane>(&collision.shape);
    for (int k = 0; k < dimensions; ++k) {
        const bool goes_on = body.endless[k] || (plane && std::abs(plane->normal[k]) < kParallel);
        if (!domain.periodic[k] || !goes_on || std::abs(axis[k]) > 1.0 - kParallel) continue;
        const std::string name(1, "xyz"[k]);
        return Error{ErrorCode::scene_invalid,
                     "turns the object out of the periodic axis " + name + ", along which it goes on",
                     path + ".motion.angle",
                     "make the object shorter than the period, or the domain not periodic" +
                         std::string(dimensions == 2 ? "" : ", or turn it about " + name)};
    }
    return proto::Done{};
}

proto::ObjectDesc moved_by(const proto::ObjectDesc& object, const Vec3& displacement) {
    proto::ObjectDesc moved = object;
    moved.shape = moved_by(object.shape, displacement);
    if (moved.motion) moved.motion->pivot = plus(moved.motion->pivot, displacement);
    return moved;
}

bool may_hold_fluid(const proto::ObjectDesc& object, const std::optional<solver::RigidState>& state, const Vec3& x,
                    int dimensions, double slack) {
    Vec3 at_rest = x;
    if (state) {  // back into the object's own frame: pivot + R^T (x - pivot - translation)
        const Vec3 arm = minus(minus(x, state->pivot), state->translation);
        const std::array<double, 9>& r = state->rotation;
        for (int k = 0; k < 3; ++k)
            at_rest[k] = state->pivot[k] + r[k] * arm[0] + r[3 + k] * arm[1] + r[6 + k] * arm[2];
    }
    const bool is_plane = std::holds_alternative<proto::PlaneDesc>(object.shape);
    if (object.role == proto::ObjectRole::container && !is_plane)
        return contains(object.shape, at_rest, dimensions, slack);
    return !contains(object.shape, at_rest, dimensions, -slack);
}

}  // namespace headrace::scene
