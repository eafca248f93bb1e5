// One particle explained: its state, its neighbours, and what each term of the model does to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/solver/particles.h"

namespace headrace::solver {

struct NeighbourInspection {
    std::optional<Index> id;  // of a fluid particle; else a wall's
    std::string object;       // the wall's object; empty for fluid
    double distance{};        // [m]
    double weight{};          // [1] V_j W_ij
};

struct TermInspection {
    std::string term;     // as in the plan
    Vec3 acceleration{};  // [m/s^2]
};

struct ParticleInspection {
    Index id{};
    Vec3 x{}, v{}, a{};        // [m], [m/s], [m/s^2]
    double rho{}, p{};         // [kg/m^3], [Pa]
    double concentration{};    // [1] sum of V_j W_ij, itself and walls included
    double min_eigenvalue{1};  // [1] smallest of the moment matrix; below about 0.75 at a free surface
    std::vector<NeighbourInspection> neighbours;  // nearest first
    std::vector<TermInspection> terms;            // they add up to a
};

}  // namespace headrace::solver
