#include "server/solver/boundaries/kernel_sections.h"

#include <cmath>
#include <numbers>

namespace headrace::solver {

Section integrate_section(const SectionKernel& kernel, int extent, double s) {
    // Midpoint rule in u, t = u^2 times the section's radius: smooth at both ends, error 1e-6 of the whole.
    constexpr int kSlices = 200;
    Section sum;
    const double R = kernel.support, reach2 = R * R - s * s;
    if (!(reach2 > 0.0)) return sum;
    const auto add = [&](double weight, double t) {
        const double r2 = s * s + t * t, r = std::sqrt(r2), F = kernel.F(r);
        sum.W += weight * kernel.W(r);
        sum.F += weight * F;
        sum.F_tt += weight * F * t * t / (extent == 2 ? 2.0 : 1.0);
        sum.F_shifted += weight * kernel.F_shifted(r);
        sum.F_yy_r2 += weight * F * (r2 > 0.0 ? s * s / r2 : 0.0);
    };
    if (extent == 0) {
        add(1.0, 0.0);
        if (s == 0.0) sum.F_yy_r2 = sum.F;  // the limit
        return sum;
    }
    const double reach = std::sqrt(reach2);
    for (int k = 0; k < kSlices; ++k) {
        const double u = (k + 0.5) / kSlices, t = reach * u * u, width = 2.0 * reach * u / kSlices;
        add(width * (extent == 1 ? 2.0 : 2.0 * std::numbers::pi * t), t);
    }
    return sum;
}

SectionTable make_section_table(const SectionKernel& kernel, int extent) {
    return {0.0, kernel.support, kSectionSteps, [&](double s) { return integrate_section(kernel, extent, s); }};
}

}  // namespace headrace::solver
