// Fills the solid side of one primitive with dummy particles, in the primitive's own frame.
//
//   box       tensor product of one lattice per axis: beyond a container's face at (k + 1/2) dx, between the faces
//             L / round(L / dx) apart; edges and corners are filled. An obstacle's are those at most the depth inside.
//   sphere    shells at r +- (k + 1/2) dx, cut into zones and those into equal parts (2D: rings of equal parts)
//   cylinder  rings at R +- (k + 1/2) dx times layers along the axis, which end as a box's do
//   plane     layers at (k + 1/2) dx of a lattice that lies along the domain's axes where the plane does: positions
//             min + (i + 1/2) dx, on a periodic axis one period L / round(L / dx) apart; else through the plane's point
//
// V of a dummy is the volume of its cell; the cells of a primitive tile its solid layer without gap or overlap.
// Round obstacles that the layers would fill to the middle are cut into whole shells near dx thick.
#pragma once

#include <cstddef>
#include <vector>

#include "server/solver/boundaries/primitives.h"

namespace headrace::solver {

// More throw std::length_error: the objects are far larger than the spacing allows (these take some 4 GB).
inline constexpr std::size_t kMaxWallParticles = 20'000'000;

struct Dummy {
    Vec3 X{};        // [m] in the object's frame
    Vec3 n{};        // [1] in the object's frame, into the fluid
    double V{};      // [m^3] (2D: m^2)
    double depth{};  // [m] below the nearest surface, of a sheet: behind its face
    Index object{};  // index of the object
    Index sheet{};   // 0, or 1 + the thin panel's face
};

// What all primitives of a scene share while they are sampled.
struct SamplingSpace {
    int dimensions{3};
    double dx{};     // [m]
    double depth{};  // [m] dummies at most this deep
    int layers{};    // k = 0 .. layers - 1 have (k + 1/2) dx < depth
    Domain domain;
    bool is_bounded{true};  // of objects at rest only what lies in the domain grown by the depth; moving ones: all

    // Bounds along an axis [m]; infinite along periodic axes, where objects go on through the periods.
    double low(int axis) const;
    double high(int axis) const;
    bool holds(const Vec3& X) const;
};

SamplingSpace make_sampling_space(int dimensions, double dx, double depth, const Domain& domain);

// Appends the object's dummies.
void sample_walls(const Body& body, const SamplingSpace& space, Index object, std::vector<Dummy>& dummies);

// A plane's lattice repeats itself along `direction`: by whole periods a moving plane's dummies follow the domain.
struct Repetition {
    Vec3 direction{};       // unit vector in the plane
    double period{};        // [m]
    int periodic_axis{-1};  // of the domain, where the direction lies along one
};
std::vector<Repetition> plane_repetitions(const Plane& plane, const SamplingSpace& space);

}  // namespace headrace::solver
