// Signed distance and normal of the primitives in their own frame. A container's solid is what lies outside its
// shape, an obstacle's what lies inside, a plane's the side its normal points away from.
//
// Endless axes: in a domain periodic along an axis, a box or a cylinder lying along it that is as long as the period or
// longer has no ends there, it goes on through all periods. A shorter one keeps both ends, even where one of them lies
// on the domain's boundary.
#pragma once

#include <array>

#include "server/solver/objects.h"

namespace headrace::solver {

// A collision object as geometry.
struct Body {
    int dimensions{3};
    Primitive shape;
    bool is_container{};
    std::array<bool, 3> endless{};

    bool is_endless() const { return endless[0] || endless[1] || endless[2]; }
};

Body make_body(const CollisionObject& object, const Domain& domain, int dimensions);

struct SurfacePoint {
    double distance{};  // [m] to the nearest point of the surface, positive on the fluid's side
    Vec3 normal{};      // [1] unit vector along which the distance grows
};

// On a surface's edge and on its medial axis the normal is one of the possible ones, always the same.
SurfacePoint nearest_surface(const Body& body, const Vec3& X);

Vec3 center_of(const Primitive& shape);  // [m] of a plane: its point

// [m] of a sphere around the centre that holds the shape; +infinity of planes and endless ones.
double bounding_radius(const Body& body);

}  // namespace headrace::solver
