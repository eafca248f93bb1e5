// Closed forms of confined and of still flow. rho, rho0 [kg/m^3], nu [m^2/s], lengths in m.
#pragma once

namespace headrace::exact {

struct Flow2D {
    double u{}, v{};  // [m/s]
    double p{};       // [Pa], mean 0
};

// Taylor-Green vortex in the periodic square of side L: decays with exp(-8 pi^2 nu t / L^2).
Flow2D taylor_green(double x, double y, double t, double U, double L, double nu, double rho);

// Start-up from rest between plates y = 0 and y = L (Morris, Fox, Zhu 1997, J. Comput. Phys. 136, 214) [m/s].
double couette(double y, double t, double V0, double L, double nu);    // upper plate moves with V0
double poiseuille(double y, double t, double F, double L, double nu);  // body force F [m/s^2]

// A weakly compressible column at rest.
struct StillColumn {
    double rho0{};  // [kg/m^3]
    double c0{};    // [m/s]
    double g{};     // [m/s^2]
    bool tait{};    // exponent 7; else p = c0^2 (rho - rho0)

    double pressure(double depth) const;  // [Pa] below the surface
    double density(double depth) const;   // [kg/m^3]
    double depth_of(double load) const;   // [m] of a column of this mass per area [kg/m^2]
};

}  // namespace headrace::exact
