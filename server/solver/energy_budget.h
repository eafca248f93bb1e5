// Where the energy of the fluid is and where it went. J; in 2D J/m.
#pragma once

namespace headrace::solver {

struct EnergyBudget {
    double kinetic{};
    double potential{};   // of gravity, -sum of m g.x
    double internal{};    // of compression, from the state equation; 0 at rest density
    double dissipated{};  // since the energies are followed: by viscosity, density diffusion, shifting
    double work{};        // since then: done on the fluid by moving walls and body forces
    double balance{};     // (kinetic + potential + internal) now - then + dissipated - work: what the scheme lost
};

}  // namespace headrace::solver
