// Gravity, capillary and sound waves of small amplitude.
#pragma once

#include <complex>

namespace headrace::exact {

// [rad/s] of a standing gravity wave on depth H: omega^2 = g k tanh(k H).
double gravity_wave_frequency(double k, double H, double g);

// Exact linear standing wave with viscosity on depth H: exp(s t), s = -rate + i omega. Free surface without stress;
// bottom free-slip, or no-slip. The root of the 4 x 4 determinant of the boundary conditions.
std::complex<double> viscous_wave_eigenvalue(double k, double H, double g, double nu, bool no_slip_bottom);

// Free drop in 2D, mode n [rad/s]: omega^2 = n (n^2 - 1) sigma / (rho R^3) (Lamb, Hydrodynamics).
double drop_frequency_2d(int n, double sigma, double rho, double R);
// Leading-order decay rate of its amplitude [1/s].
double drop_decay_2d(int n, double nu, double R);

// Phase speed over c0 of a sound wave along an axis of the square (2D) or cubic (3D) lattice with the uncorrected
// gradient of a kernel: S(k)/k, S(k) = sum_j V (x_j/r_j) (-dW/dr) sin(k x_j). Lengths in spacings.
enum class SoundKernel { cubic_spline, wendland_c2 };
double lattice_sound_speed(SoundKernel kernel, int dimensions, double h_over_spacing, double spacings_per_wavelength);

}  // namespace headrace::exact
