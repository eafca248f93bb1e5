#include "server/solver/models/thesis_sums.h"

#include <algorithm>
#include <cmath>

#include "server/solver/forces/body_force.h"
#include "server/solver/forces/pressure.h"
#include "server/solver/forces/separation.h"
#include "server/solver/forces/surface_tension.h"
#include "server/solver/forces/viscosity.h"
#include "server/solver/kernels.h"

namespace headrace::solver {
namespace {

#define HEADRACE_ALWAYS_INLINE [[gnu::always_inline]] inline

// rho_i = sum_j m W_poly6(x_i - x_j), j = i included (2.17)
template <int D>
HEADRACE_ALWAYS_INLINE void sum_density(const SumInput& in, std::size_t first, std::size_t last, Candidates& candidates,
                                        double* rho) {
    const Poly6<D> poly6(in.parameters.support_radius);
    const double m = in.parameters.particle_mass;
    const VectorField& x = in.particles.x;
    std::array<const double*, D> fields;
    for (int k = 0; k < D; ++k) fields[k] = x[k].data();

    for (std::size_t c = first; c < last; ++c) {
        const std::size_t count = candidates.gather(in.grid.around(c), fields);
        const double* x_j = candidates.field(0);
        const double* y_j = candidates.field(1);
        const double* z_j = candidates.field(D - 1);
        const Run cell = in.grid.cell(c);
        for (Index i = cell.begin; i < cell.end; ++i) {
            const double x_i = x[0][i], y_i = x[1][i], z_i = x[D - 1][i];
            double sum = 0.0;
#pragma omp simd reduction(+ : sum) aligned(x_j, y_j, z_j : Candidates::kAlignment)
            for (std::size_t j = 0; j < count; ++j) {
                const double dx = x_i - x_j[j], dy = y_i - y_j[j], dz = D == 3 ? z_i - z_j[j] : 0.0;
                sum += poly6.W(dx * dx + dy * dy + dz * dz);
            }
            rho[i] = m * sum;
        }
    }
}

// Pressure force density on i from the other particles at its very place, see separation.h. Rare, so plain.
template <int D>
[[gnu::noinline]] std::array<double, D> sum_separation(const SumInput& in, std::size_t c, Index i) {
    const Particles& particles = in.particles;
    const ThesisParameters& parameters = in.parameters;
    const double reach = kCoincident * parameters.support_radius;
    const double slope = -Spiky<D>(parameters.support_radius).slope(0.0);
    std::array<double, D> f{};
    for_each_candidate(in.grid, c, [&](Index j) {
        double r2 = 0.0;
        for (int k = 0; k < D; ++k)
            r2 += (particles.x[k][i] - particles.x[k][j]) * (particles.x[k][i] - particles.x[k][j]);
        if (j == i || r2 >= reach * reach) return;
        const PressurePair pair{particles.p[i], particles.p[j], particles.rho[i], in.volume[j],
                                parameters.particle_mass};
        const double weight = parameters.pressure_form == PressureForm::mean
                                  ? pressure_weight<PressureForm::mean>(pair)
                                  : pressure_weight<PressureForm::symmetric>(pair);
        const std::array<double, D> e = separation_direction<D>(particles.id[i], particles.id[j], in.step);
        for (int k = 0; k < D; ++k) f[k] += std::abs(weight) * slope * e[k];
    });
    return f;
}

// a_i = (f_p + f_v + f_s)/rho_i + g (2.16). Self-contributions of pressure and viscosity vanish by themselves.
template <int D, PressureForm Form, bool HasViscosity, bool HasTension>
HEADRACE_ALWAYS_INLINE void sum_forces(const SumInput& in, std::size_t first, std::size_t last, Candidates& candidates,
                                       const std::array<double*, 3>& a) {
    const ThesisParameters& parameters = in.parameters;
    const Particles& particles = in.particles;
    const Spiky<D> spiky(parameters.support_radius);
    const ViscosityKernel<D> viscosity_kernel(parameters.support_radius);
    const Poly6<D> poly6(parameters.support_radius);
    const double m = parameters.particle_mass, mu = parameters.viscosity;
    // Below this distance a pair has no direction: none of the thesis's at r = 0, none to trust when they separate.
    const double reach = parameters.separate_coincident ? kCoincident * parameters.support_radius : 0.0;
    const double reach2 = reach * reach;

    constexpr std::size_t kV = D, kP = D + 1, kVelocity = D + 2;
    std::array<const double*, HasViscosity ? 2 * D + 2 : D + 2> fields;
    fields[kV] = in.volume;
    fields[kP] = particles.p.data();
    for (int k = 0; k < D; ++k) {
        fields[k] = particles.x[k].data();
        if constexpr (HasViscosity) fields[kVelocity + k] = particles.v[k].data();
    }

    for (std::size_t c = first; c < last; ++c) {
        const std::size_t count = candidates.gather(in.grid.around(c), fields);
        const double* x_j = candidates.field(0);
        const double* y_j = candidates.field(1);
        const double* z_j = candidates.field(D - 1);
        const double* V_j = candidates.field(kV);
        const double* p_j = candidates.field(kP);
        // Without viscosity these are never read.
        const double* vx_j = candidates.field(HasViscosity ? kVelocity : 0);
        const double* vy_j = candidates.field(HasViscosity ? kVelocity + 1 : 0);
        const double* vz_j = candidates.field(HasViscosity ? kVelocity + D - 1 : 0);
        const Run cell = in.grid.cell(c);
        for (Index i = cell.begin; i < cell.end; ++i) {
            const double x_i = particles.x[0][i], y_i = particles.x[1][i], z_i = particles.x[D - 1][i];
            const double vx_i = particles.v[0][i], vy_i = particles.v[1][i], vz_i = particles.v[D - 1][i];
            const double p_i = particles.p[i], rho_i = particles.rho[i];
            double fx = 0.0, fy = 0.0, fz = 0.0, nx = 0.0, ny = 0.0, nz = 0.0, laplacian_c = 0.0, coincident = 0.0;
#pragma omp simd reduction(+ : fx, fy, fz, nx, ny, nz, laplacian_c, coincident) \
    aligned(x_j, y_j, z_j, V_j, p_j, vx_j, vy_j, vz_j : Candidates::kAlignment)
            for (std::size_t j = 0; j < count; ++j) {
                const double dx = x_i - x_j[j], dy = y_i - y_j[j], dz = D == 3 ? z_i - z_j[j] : 0.0;
                const double r2 = dx * dx + dy * dy + dz * dz;
                const double r = std::sqrt(r2);
                const bool is_apart = r2 > reach2;
                const double inv_r = (is_apart ? 1.0 : 0.0) / (is_apart ? r : 1.0);
                coincident += is_apart ? 0.0 : 1.0;

                const PressurePair pair{p_i, p_j[j], rho_i, V_j[j], m};
                const double f_p = -pressure_weight<Form>(pair) * spiky.gradient_factor(r, inv_r);
                fx += f_p * dx;
                fy += f_p * dy;
                if constexpr (D == 3) fz += f_p * dz;
                if constexpr (HasViscosity) {
                    const double f_v = viscosity_weight(mu, V_j[j], viscosity_kernel.laplacian(r));
                    fx += f_v * (vx_j[j] - vx_i);
                    fy += f_v * (vy_j[j] - vy_i);
                    if constexpr (D == 3) fz += f_v * (vz_j[j] - vz_i);
                }
                if constexpr (HasTension) {
                    const double n = V_j[j] * poly6.gradient_factor(r2);
                    nx += n * dx;
                    ny += n * dy;
                    if constexpr (D == 3) nz += n * dz;
                    laplacian_c += V_j[j] * poly6.laplacian(r2);
                }
            }
            std::array<double, 3> f{fx, fy, fz};
            if constexpr (HasTension) {
                const double f_s = tension_factor(parameters.surface_tension, laplacian_c, nx * nx + ny * ny + nz * nz,
                                                  parameters.surface_tension_threshold);
                f[0] += f_s * nx;
                f[1] += f_s * ny;
                f[2] += f_s * nz;
            }
            // The particle itself counts as one.
            if (coincident > 1.0 && parameters.separate_coincident) {
                const std::array<double, D> apart = sum_separation<D>(in, c, i);
                for (int k = 0; k < D; ++k) f[k] += apart[k];
            }
            for (int k = 0; k < D; ++k) a[k][i] = f[k] / rho_i + body_acceleration(parameters.gravity[k]);
        }
    }
}

// One instance per instruction set; the sums above are inlined into each.
template <int D>
void density_baseline(const SumInput& in, std::size_t first, std::size_t last, Candidates& c, double* rho) {
    sum_density<D>(in, first, last, c, rho);
}
template <int D>
HEADRACE_TARGET_AVX2 void density_avx2(const SumInput& in, std::size_t first, std::size_t last, Candidates& c,
                                       double* rho) {
    sum_density<D>(in, first, last, c, rho);
}
template <int D>
HEADRACE_TARGET_AVX512 void density_avx512(const SumInput& in, std::size_t first, std::size_t last, Candidates& c,
                                           double* rho) {
    sum_density<D>(in, first, last, c, rho);
}

template <int D, PressureForm Form, bool HasViscosity, bool HasTension>
void forces_baseline(const SumInput& in, std::size_t first, std::size_t last, Candidates& c,
                     const std::array<double*, 3>& a) {
    sum_forces<D, Form, HasViscosity, HasTension>(in, first, last, c, a);
}
template <int D, PressureForm Form, bool HasViscosity, bool HasTension>
HEADRACE_TARGET_AVX2 void forces_avx2(const SumInput& in, std::size_t first, std::size_t last, Candidates& c,
                                      const std::array<double*, 3>& a) {
    sum_forces<D, Form, HasViscosity, HasTension>(in, first, last, c, a);
}
template <int D, PressureForm Form, bool HasViscosity, bool HasTension>
HEADRACE_TARGET_AVX512 void forces_avx512(const SumInput& in, std::size_t first, std::size_t last, Candidates& c,
                                          const std::array<double*, 3>& a) {
    sum_forces<D, Form, HasViscosity, HasTension>(in, first, last, c, a);
}

template <int D, PressureForm Form, bool HasViscosity, bool HasTension>
constexpr std::array<ForceSum, 3> kForceSumsOf{
    forces_baseline<D, Form, HasViscosity, HasTension>,
    forces_avx2<D, Form, HasViscosity, HasTension>,
    forces_avx512<D, Form, HasViscosity, HasTension>,
};

// [viscosity][surface tension]
template <int D, PressureForm Form>
constexpr std::array<std::array<std::array<ForceSum, 3>, 2>, 2> kForceSums{{
    {kForceSumsOf<D, Form, false, false>, kForceSumsOf<D, Form, false, true>},
    {kForceSumsOf<D, Form, true, false>, kForceSumsOf<D, Form, true, true>},
}};

template <int D>
constexpr std::array<DensitySum, 3> kDensitySums{density_baseline<D>, density_avx2<D>, density_avx512<D>};

}  // namespace

DensitySum choose_density_sum(int dimensions, Isa isa) {
    const auto set = static_cast<std::size_t>(isa);
    return dimensions == 3 ? kDensitySums<3>[set] : kDensitySums<2>[set];
}

ForceSum choose_force_sum(int dimensions, const ForceTerms& terms, Isa isa) {
    constexpr auto kMean = PressureForm::mean, kSymmetric = PressureForm::symmetric;
    const bool is_mean = terms.pressure_form == kMean;
    const auto& table = dimensions == 3 ? (is_mean ? kForceSums<3, kMean> : kForceSums<3, kSymmetric>)
                                        : (is_mean ? kForceSums<2, kMean> : kForceSums<2, kSymmetric>);
    return table[terms.viscosity][terms.surface_tension][static_cast<std::size_t>(isa)];
}

}  // namespace headrace::solver
