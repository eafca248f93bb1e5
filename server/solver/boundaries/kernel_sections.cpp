#include "server/solver/boundaries/kernel_sections.h"

#include <cmath>

namespace headrace::solver {

Section sum_section(const SectionKernel& kernel, int extent, double cell, double s) {
    Section sum;
    const double R = kernel.support, reach2 = R * R - s * s;
    if (!(reach2 > 0.0)) return sum;
    const auto add = [&](double weight, double t2) {
        const double r2 = s * s + t2, r = std::sqrt(r2), F = kernel.F(r);
        sum.W += weight * kernel.W(r);
        sum.F += weight * F;
        sum.F_tt += weight * F * t2 / (extent == 2 ? 2.0 : 1.0);
        sum.F_shifted += weight * kernel.F_shifted(r);
        sum.F_yy_r2 += weight * F * (r2 > 0.0 ? s * s / r2 : 1.0);
    };
    if (extent == 0) {
        add(1.0, 0.0);
        return sum;
    }
    const int reach = static_cast<int>(std::sqrt(reach2) / cell);
    for (int i = 0; i <= reach; ++i) {
        const double along = i * cell, t2 = along * along;
        if (extent == 1) {
            add((i > 0 ? 2.0 : 1.0) * cell, t2);
            continue;
        }
        // The points of one quarter, the axis from which it begins included, stand for four; the centre for itself.
        if (i == 0) {
            add(cell * cell, 0.0);
            continue;
        }
        for (int j = 0; j <= reach; ++j) {
            const double other = j * cell, both2 = t2 + other * other;
            if (both2 >= reach2) break;
            add(4.0 * cell * cell, both2);
        }
    }
    return sum;
}

SectionTable make_section_table(const SectionKernel& kernel, int extent, double cell) {
    return {0.0, kernel.support, kSectionSteps, [&](double s) { return sum_section(kernel, extent, cell, s); }};
}

}  // namespace headrace::solver
