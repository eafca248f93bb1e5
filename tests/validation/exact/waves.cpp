#include "tests/validation/exact/waves.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace headrace::exact {

namespace {

using Complex = std::complex<double>;
using Matrix = std::array<std::array<Complex, 4>, 4>;

Complex determinant(Matrix m) {
    Complex product = 1.0;
    for (int column = 0; column < 4; ++column) {
        int pivot = column;
        for (int row = column; row < 4; ++row)
            if (std::abs(m[row][column]) > std::abs(m[pivot][column])) pivot = row;
        if (pivot != column) {
            std::swap(m[pivot], m[column]);
            product = -product;
        }
        product *= m[column][column];
        for (int row = column + 1; row < 4; ++row) {
            const Complex factor = m[row][column] / m[column][column];
            for (int k = column; k < 4; ++k) m[row][k] -= factor * m[column][k];
        }
    }
    return product;
}

// Vertical velocity w = sum of e^{kz}, e^{-k(z+H)}, e^{mz}, e^{-m(z+H)}, m^2 = k^2 + s/nu: its derivatives 0..3 at z,
// one row per derivative.
Matrix vertical_velocity(Complex k, Complex m, double H, double z) {
    Matrix rows{};
    const std::array<Complex, 4> value{std::exp(k * z), std::exp(-k * (z + H)), std::exp(m * z),
                                       std::exp(-m * (z + H))};
    const std::array<Complex, 4> slope{k, -k, m, -m};
    for (int column = 0; column < 4; ++column) {
        Complex derivative = value[column];
        for (int order = 0; order < 4; ++order, derivative *= slope[column]) rows[order][column] = derivative;
    }
    return rows;
}

// Rows: no flow through the bottom; no stress (or no slip) there; no shear stress and no normal stress at the surface.
// p/rho = (nu (w''' - k^2 w') - s w') / k^2 and eta = w/s.
Complex boundary_determinant(Complex s, double k, double H, double g, double nu, bool no_slip_bottom) {
    const Complex m = std::sqrt(k * k + s / nu);
    const Matrix top = vertical_velocity(k, m, H, 0.0), bottom = vertical_velocity(k, m, H, -H);
    Matrix rows{};
    for (int c = 0; c < 4; ++c) {
        rows[0][c] = bottom[0][c];
        rows[1][c] = no_slip_bottom ? bottom[1][c] / k : bottom[2][c] / (k * k);
        rows[2][c] = (top[2][c] + k * k * top[0][c]) / (k * k);
        const Complex p = (nu * (top[3][c] - k * k * top[1][c]) - s * top[1][c]) / (k * k);
        rows[3][c] = (p - 2 * nu * top[1][c] - g * top[0][c] / s) * k / g;
    }
    return determinant(rows);
}

// dW/dr times h^(d+1) at q = r/h, support 2h.
double kernel_slope(SoundKernel kernel, int dimensions, double q) {
    if (q >= 2.0) return 0.0;
    const double pi = std::numbers::pi;
    if (kernel == SoundKernel::wendland_c2)
        return (dimensions == 2 ? 7 / (4 * pi) : 21 / (16 * pi)) * (-5 * q) * std::pow(1 - q / 2, 3);
    const double factor = dimensions == 2 ? 10 / (7 * pi) : 1 / pi;
    return factor * (q < 1.0 ? -3 * q + 2.25 * q * q : -0.75 * (2 - q) * (2 - q));
}

}  // namespace

double gravity_wave_frequency(double k, double H, double g) {
    return std::sqrt(g * k * std::tanh(k * H));
}

// Newton's method from the leading-order damping; the slope by a central difference.
Complex viscous_wave_eigenvalue(double k, double H, double g, double nu, bool no_slip_bottom) {
    const double omega0 = gravity_wave_frequency(k, H, g);
    Complex s{-2 * nu * k * k, omega0};
    if (no_slip_bottom) s -= std::sqrt(nu * omega0 / 2) * k / std::sinh(2 * k * H);
    const auto f = [&](Complex at) { return boundary_determinant(at, k, H, g, nu, no_slip_bottom); };
    for (int iteration = 0; iteration < 50; ++iteration) {
        const double delta = 1e-6 * omega0;
        const Complex change = f(s) * 2.0 * delta / (f(s + delta) - f(s - delta));
        s -= change;
        if (std::abs(change) < 1e-13 * omega0) break;
    }
    return s;
}

double drop_frequency_2d(int n, double sigma, double rho, double R) {
    return std::sqrt(n * (n * n - 1) * sigma / (rho * R * R * R));
}

double drop_decay_2d(int n, double nu, double R) {
    return 2 * n * (n - 1) * nu / (R * R);
}

double lattice_sound_speed(SoundKernel kernel, int dimensions, double h, double spacings_per_wavelength) {
    const double k = 2 * std::numbers::pi / spacings_per_wavelength;
    const int reach = static_cast<int>(std::ceil(2 * h));
    const int deep = dimensions == 3 ? reach : 0;
    double sum = 0.0;
    for (int z = -deep; z <= deep; ++z)
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                const double r = std::sqrt(x * x + y * y + z * z);
                if (r == 0.0) continue;
                sum -= x / r * kernel_slope(kernel, dimensions, r / h) * std::sin(k * x);
            }
    return sum / std::pow(h, dimensions + 1) / k;
}

}  // namespace headrace::exact
