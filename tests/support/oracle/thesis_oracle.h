// The judge of the fast thesis model: the same equations over all pairs, one after the other, in double precision.
// Source: D. Staubach, "Smoothed Particle Hydrodynamics - Real-Time Fluid Simulation Approach", bachelor thesis,
// FAU Erlangen-Nuernberg, 2010; equation numbers are its own. Kernels: Mueller, Charypar, Gross 2003; in 2D the same
// polynomials normalised over the disc. h is the support radius.
//
// Shares no code with server/solver; only the plain structs of objects.h are its input.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "server/solver/objects.h"

namespace headrace::oracle {

using Vec3 = std::array<double, 3>;  // 2D: the third component stays 0

enum class PressureForm { averaged, symmetric };  // Eq. 2.22, Eq. 2.21

// Tables 3.1 and 3.2.
struct ThesisParameters {
    double dt{0.01};          // [s]
    Vec3 g{0.0, -9.82, 0.0};  // [m/s^2]
    double rho0{998.29};      // [kg/m^3]
    double m{0.02};           // [kg] (2D: kg/m)
    double mu{3.5};           // [Pa s]
    double sigma{0.0728};     // [N/m]
    double l{7.065};          // [1/m]
    double k{3.0};            // [J/kg = m^2/s^2]
    double c_R{0.0};          // [1]
    double h{0.0457};         // [m]
    PressureForm pressure_form{PressureForm::averaged};
};

struct Particle {
    Vec3 x{};       // [m]
    Vec3 v_half{};  // [m/s]   leap velocity, the carried state
    Vec3 v{};       // [m/s]   velocity of the step just done (2.36)
    Vec3 a{};       // [m/s^2] evaluated at the x the step began with, as rho and p are
    double rho{};   // [kg/m^3]
    double p{};     // [Pa]
};

// The smoothing kernels of Appendix C as functions of the distance r <= h.
class Kernels {
  public:
    Kernels(int dimensions, double h);
    double poly6(double r) const;           // W
    double poly6_gradient(double r) const;  // factor of the vector x_i - x_j
    double poly6_laplacian(double r) const;
    double spiky_gradient(double r) const;  // factor of the unit vector (x_i - x_j)/r
    double viscosity_laplacian(double r) const;

  private:
    int dimensions_;
    double h_;
    double poly6_{}, poly6_gradient_{}, spiky_gradient_{}, viscosity_laplacian_{};  // prefactors
};

// Where and how a particle hit an object.
struct Contact {
    Vec3 cp{};   // [m] contact point
    double d{};  // [m] penetration depth
    Vec3 n{};    // unit normal; its sign does not matter to the response
};

// Section 2.5.1 for a particle that moved from `from` to `to`. Box obstacles are not in the thesis: the particle is put
// on the face through which its path entered, or, if it began inside and is still there, on the nearest face.
std::optional<Contact> find_contact(const solver::CollisionObject& object, const Vec3& from, const Vec3& to,
                                    int dimensions);

class ThesisOracle {
  public:
    ThesisOracle(int dimensions, const ThesisParameters& parameters, std::vector<solver::CollisionObject> objects);

    void add_particle(const Vec3& x, const Vec3& v);
    // Forces at t = 0 and the leap velocity of Eq. 2.35.
    void initialise();
    void step();

    std::vector<Particle>& particles() { return particles_; }
    const std::vector<Particle>& particles() const { return particles_; }

  private:
    void compute_density();
    void compute_pressure();
    void compute_acceleration();
    Vec3 compute_force(std::size_t i) const;  // [N/m^3] without gravity
    void collide(Particle& particle, const Vec3& from) const;
    bool respond(Particle& particle, const solver::CollisionObject& object, const Vec3& from) const;  // true: was hit

    int dimensions_;
    ThesisParameters parameters_;
    Kernels kernels_;
    std::vector<solver::CollisionObject> objects_;  // in the order of their application
    std::vector<Particle> particles_;
};

}  // namespace headrace::oracle
