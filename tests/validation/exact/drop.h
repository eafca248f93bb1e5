// The elliptical drop (Monaghan 1994, J. Comput. Phys. 110, 399): a disc of inviscid fluid, free all around, with the
// velocity (s x, -s y), stays an ellipse of semi-axes a (x), b (y). With a central body force -B^2 r it oscillates
// (Antuono et al. 2015, Comput. Methods Appl. Mech. Eng. 289, 209):
//   a' = s a,  b' = -s b,  s' = (s^2 + B^2) (b^2 - a^2) / (a^2 + b^2)
#pragma once

namespace headrace::exact {

struct Ellipse {
    double s{};  // [1/s] du/dx
    double a{};  // [m]
    double b{};  // [m]
};

class EllipticalDrop {
  public:
    // s0 [1/s], B [1/s], R [m]: a = b = R and s = s0 at t = 0.
    EllipticalDrop(double s0, double B, double R);

    Ellipse at(double t);                 // t [s] >= 0; cheap when t does not decrease
    double energy(double t, double rho);  // [J/m] kinetic and of the body force
    double period() const;                // [s]; B > 0

  private:
    double s0_, B_, R_;
    double step_;  // [s] of the Runge-Kutta integration
    double t_{0.0};
    Ellipse state_;
};

// p at the centre [Pa]; over the ellipse p = centre (1 - x^2/a^2 - y^2/b^2).
double drop_centre_pressure(const Ellipse& ellipse, double B, double rho);

}  // namespace headrace::exact
