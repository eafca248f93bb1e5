// Collision objects as implicit primitives (Staubach 2010, section 2.5.1): what they are, not what they do.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <variant>

#include "server/solver/particles.h"

namespace headrace::solver {

struct Box {             // axis-aligned in the object's own frame
    Vec3 center{};       // [m]
    Vec3 half_extent{};  // [m] ext of Eq. 2.42
};

struct Sphere {       // 2D: disc
    Vec3 center{};    // [m]
    double radius{};  // [m]
};

struct Cylinder {              // round, with flat ends; 3D only
    Vec3 center{};             // [m]
    Vec3 axis{0.0, 1.0, 0.0};  // unit vector
    double radius{};           // [m]
    double half_length{};      // [m]
};

struct Plane {                   // half space
    Vec3 point{};                // [m]
    Vec3 normal{0.0, 1.0, 0.0};  // unit vector, towards the fluid
};

using Primitive = std::variant<Box, Sphere, Cylinder, Plane>;

enum class Role { container, obstacle };  // a plane's role does not matter: its normal tells
enum class Slip { by_model, free_slip, no_slip };

// Place and motion of a rigid body at a time: a point X of the body at rest is at pivot + translation + R (X - pivot).
struct RigidState {
    Vec3 pivot{};                                               // [m]
    Vec3 translation{};                                         // [m]
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  // R, row by row
    Vec3 velocity{};                                            // [m/s]     of the pivot
    Vec3 acceleration{};                                        // [m/s^2]   of the pivot
    Vec3 angular_velocity{};                                    // [rad/s]
    Vec3 angular_acceleration{};                                // [rad/s^2]
    Vec3 surface_velocity{};                                    // [m/s] added on the surface only: a belt
};

struct CollisionObject {
    std::string name;
    Role role{Role::obstacle};
    Primitive shape;  // at rest, in its own frame
    Slip slip{Slip::by_model};
    std::function<RigidState(double t)> motion;  // empty: at rest
    bool is_belt{false};                         // the motion is that of a belt alone: nothing changes its place
};

// Particles outside fault the run; along a periodic axis what leaves at max enters at min.
struct Domain {
    Vec3 min{};  // [m]
    Vec3 max{};  // [m]
    std::array<bool, 3> periodic{};

    bool has_periodic_axis() const { return periodic[0] || periodic[1] || periodic[2]; }
};

}  // namespace headrace::solver
