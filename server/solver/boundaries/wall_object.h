// One object of the scene as a wall: its body, where it is now, and how it goes on through a periodic domain.
#pragma once

#include <functional>
#include <vector>

#include "server/solver/boundaries/primitives.h"
#include "server/solver/boundaries/wall_sampling.h"

namespace headrace::solver {

class WallObject {
  public:
    // Placed as at time t [s].
    WallObject(const CollisionObject& object, const SamplingSpace& space, double t);

    struct Change {
        bool of_place{};
        bool of_motion{};  // velocities or accelerations
    };
    Change move_to(double t);

    const Body& body() const { return body_; }
    bool is_moving() const { return static_cast<bool>(motion_); }

    // Nearest surface as seen from x, over all periods; `image` gets the point of all that stand for x which sees it.
    SurfacePoint surface(const Vec3& x, Vec3* image = nullptr) const;
    // Is x in the solid? The surface itself is not.
    bool holds(const Vec3& x) const;

    // Of the material at a point seen as surface() says; the belt's velocity along the surface.
    Vec3 velocity(const Vec3& image, const Vec3& normal) const;
    Vec3 acceleration(const Vec3& image) const;

    // Where a dummy of this object is now, not yet brought back into a periodic domain.
    Vec3 place(const Dummy& dummy) const;
    // Brings it into the domain; false where it does not belong there: too far outside, or a plane beyond its period.
    bool bring_into_domain(Vec3& x) const;

    Vec3 to_body(const Vec3& x) const;
    Vec3 to_world(const Vec3& X) const;
    Vec3 turn(const Vec3& n) const;  // a direction, from the body's frame

    // Of all points that stand for x in a periodic domain the one nearest to the object's centre.
    Vec3 nearest_image(const Vec3& x) const;

  private:
    void find_images();
    void follow_domain();

    Body body_;
    std::function<RigidState(double)> motion_;
    RigidState state_;
    SamplingSpace space_;
    Vec3 center_{};                        // [m] now
    std::array<bool, 3> wraps_{};          // axes along which it goes on through the periods
    std::vector<Vec3> images_;             // [m] displacements besides 0 under which a point may see another part of it
    std::vector<Repetition> repetitions_;  // of a moving plane
    std::vector<double> middle_;           // [m] of the domain, along those
};

}  // namespace headrace::solver
