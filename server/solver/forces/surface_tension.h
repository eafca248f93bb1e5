// Surface tension, Staubach 2010, Eq. 2.27-2.31 (Müller 2003). Colour field c_i = sum_j V_j W_poly6 (2.27), its
// gradient n_i = sum_j V_j grad_W (2.28) points into the liquid; j = i is included in all three sums.
#pragma once

#include <cmath>

namespace headrace::solver {

// Factor that makes the force density f_s [N/m^3] of the gradient n [1/m]: f_s = tension_factor * n.
// f_s = -sigma laplacian_c n/|n| where |n| >= l, else 0 (2.30, 2.31): deep inside n is noise without direction.
// sigma [N/m], laplacian_c [1/m^2], threshold l [1/m].
inline double tension_factor(double sigma, double laplacian_c, double n2, double threshold) {
    const double length = std::sqrt(n2);
    if (length < threshold || length == 0.0) return 0.0;
    return -sigma * laplacian_c / length;
}

}  // namespace headrace::solver
