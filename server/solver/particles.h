// The particles: structure of arrays in storage order, which is the order of the cells they were last sorted into.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace headrace::solver {

using Vec3 = std::array<double, 3>;
using Index = std::uint32_t;

// One array per component: vector_field[axis][i]. In 2D the arrays of axis 2 are empty.
using VectorField = std::array<std::vector<double>, 3>;
using NarrowField = std::array<std::vector<float>, 3>;  // the same in single precision

struct Particles {
    int dimensions{3};  // 2 or 3

    std::vector<Index> id;  // name of the particle in slot i; set when the scene is built, moves with it when sorted

    VectorField x;            // [m]      position; integrator, collision
    VectorField v_half;       // [m/s]    leap velocity at t - dt/2 (2.33), carried by leap-frog models; else empty
    VectorField v;            // [m/s]    velocity of the step just done (2.36); integrator
    VectorField a;            // [m/s^2]  acceleration of the step just done; model
    std::vector<double> m;    // [kg]     mass (2D: kg/m); model, when it is initialised
    std::vector<double> rho;  // [kg/m^3] density of the step just done; model
    std::vector<double> p;    // [Pa]     pressure of the step just done; model

    std::size_t size() const { return id.size(); }
    void resize(std::size_t count);
};

}  // namespace headrace::solver
