// First-order consistency of the gradient: the moment matrix of a particle's neighbourhood and its inverse.
//
//   M_i = sum_j V_j (x_j - x_i) (x) grad_i W_ij,   B_i = M_i^-1      Randles & Libersky 1996, CMAME 139, 375
//
// sum_j V_j (f_j - f_i) B_i grad_i W_ij is exact for linear f. grad W is along x_ij, so M is symmetric. Walls count
// as fluid. Its smallest eigenvalue tells how much of the neighbourhood is missing: 1 inside, below 1 near a free
// surface (Marrone et al. 2010, J. Comput. Phys. 229, 3652).
#pragma once

#include "server/solver/pair.h"
#include "server/solver/symmetric.h"

namespace headrace::solver {

// V_j F x_ij (x) x_ij, the part of M that the pair gives, with the sign of -F > 0.
template <int D, class T>
HEADRACE_ALWAYS_INLINE void accumulate_moment(const Pair<D, T>& pair, const T& F, Symmetric<D, T>& M) {
    const VectorOf<D, T> weighted = scaled<D, T>(pair.V_j * F, pair.x_ij);
    for (int r = 0; r < D; ++r) {
        for (int c = r; c < D; ++c) M(r, c) -= weighted[r] * pair.x_ij[c];
    }
}

// B, or 1 where the neighbourhood is too one-sided to correct: keeping B at a free surface blows up.
template <int D>
Symmetric<D> correction_matrix(const Symmetric<D>& M, double min_eigenvalue, double threshold) {
    return min_eigenvalue >= threshold ? inverse(M) : Symmetric<D>::identity();
}

}  // namespace headrace::solver
