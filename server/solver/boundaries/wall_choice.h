// Which objects of a scene can be walls as integrals (integral_walls.h); the others stay dummy particles.
//
// An object qualifies when it is a box, a sphere, or a plane along the axes, rests (a belt may run along its surface),
// and shares no solid with others: boxes and spheres inside all containers and planes, apart from each other; they may
// touch. Containers and planes among themselves may overlap in any way: together they leave one room. Then
//
//   box, sphere obstacles   at least twice the support wide (thinner boxes are panels, with fluid on both sides)
//   containers              with no ends along a periodic axis
//   obstacles               along a periodic axis without ends, or so short that all images but one are out of reach
//
// Of boxes and spheres at most IntegralWalls::kMostObstacles: all are asked about each particle near none of them.
// Where anything moves, all objects are dummies: it may come to overlap any of them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/solver/boundaries/integral_walls.h"
#include "server/solver/boundaries/primitives.h"
#include "server/solver/objects.h"

namespace headrace::solver {

struct WallChoice {
    std::vector<char> is_integral;  // of each object
    std::string remark;             // why not all of them; empty: all, or no objects
};

WallChoice choose_integral_walls(std::span<const CollisionObject> objects, const Domain& domain, int dimensions,
                                 double support);

// For scenes that leave the choice to the model: all objects or none, and only where integrals were found to be cheaper
// and no less accurate, which is in 3D, of boxes and planes that slip. In 2D they cost the same; waves are as good or
// better with them, the pressure after an impact is worse (tests/bench/results/accuracy.md, dam_break_pressure).
WallChoice choose_walls_by_default(std::span<const CollisionObject> objects, const Domain& domain, int dimensions,
                                   double support, const std::vector<char>& no_slip);

// Puts the chosen objects into `walls`. no_slip: of each object.
void place_integral_walls(std::span<const CollisionObject> objects, const Domain& domain,
                          const std::vector<char>& is_integral, const std::vector<char>& no_slip, IntegralWalls& walls);

}  // namespace headrace::solver
