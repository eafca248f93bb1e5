// Collision objects as implicit primitives (Staubach 2010, section 2.5.1): what they are, not what they do.
#pragma once

#include <string>
#include <variant>

#include "server/solver/particles.h"

namespace headrace::solver {

struct Box {             // axis-aligned
    Vec3 center{};       // [m]
    Vec3 half_extent{};  // [m] ext of Eq. 2.42
};

struct Sphere {       // 2D: disc
    Vec3 center{};    // [m]
    double radius{};  // [m]
};

enum class Role { container, obstacle };

struct CollisionObject {
    std::string name;
    Role role{Role::obstacle};
    std::variant<Box, Sphere> shape;
};

// Particles outside fault the run.
struct Domain {
    Vec3 min{};  // [m]
    Vec3 max{};  // [m]
};

}  // namespace headrace::solver
