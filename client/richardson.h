// How far the finest of three runs is from the limit of no spacing: Richardson extrapolation, and an error bar after
// the grid convergence index of Roache 1994 (Perspective: a method for uniform reporting of grid refinement studies, J.
// Fluids Eng. 116, 405-413), in the form for unequal ratios of Celik et al. 2008 (Procedure for estimation and
// reporting of uncertainty due to discretization in CFD applications, J. Fluids Eng. 130, 078001).
//
// With spacings s3 > s2 > s1 and results f = f_exact + C s^p:
//
//   (f3 - f2)/(f2 - f1) = (s3^p - s2^p)/(s2^p - s1^p)         gives the observed order p
//   f_exact = f1 + (f1 - f2) s1^p/(s2^p - s1^p)               the extrapolated result
//   bar = F |f1 - f_exact|                                    F = 1.25: with three runs
//
// A result is a number, a curve over time or a profile: values at the same places with weights. Then |.| is the
// weighted root mean square, and the two differences must point the same way.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace headrace::client {

using Values = std::vector<double>;

// The runs of a study, in this order in every array of three.
enum Resolution { kCoarse, kMiddle, kFine };

enum class Convergence {
    identical,    // no difference past rounding: nothing to extrapolate
    monotone,     // the differences shrink and point the same way
    oscillatory,  // they point to different sides (curves: their correlation is below 1/2)
    diverging,    // they do not shrink
};

struct ResolutionEstimate {
    Convergence convergence{Convergence::identical};
    std::optional<double> order;  // p as observed, where monotone
    double order_used{};          // p of extrapolation and bar: within [0.5, 2]
    Values extrapolated;          // where monotone, else empty
    // Bar of the finest run. Not monotone: the spread of the three runs, which bounds nothing beyond them.
    double error{};
};

// sqrt(sum w v^2) over weights that sum to 1; of one number: its magnitude.
double weighted_norm(const Values& values, const Values& weights);
double weighted_distance(const Values& a, const Values& b, const Values& weights);

// `spacings` fall from coarse to fine. An order above 2, that of the method's smoothing, is an accident of cancelling
// errors: 2 is used, and the pair of runs that gives the larger bar. Below 0.5 the runs hardly converge: 0.5 is used,
// with F = 3, as Oberkampf and Roy 2010 (Verification and Validation in Scientific Computing) bound it.
ResolutionEstimate estimate_resolution(const std::array<double, 3>& spacings, const std::array<Values, 3>& values,
                                       const Values& weights);

// Bar for the finite sound speed c from runs at c and factor c. Weakly compressible flow differs from the
// incompressible one by the square of the Mach number, so by C/c^2: F |f(c) - f(factor c)| factor^2/(factor^2 - 1).
double estimate_compressibility(const Values& base, const Values& faster, const Values& weights, double factor);

}  // namespace headrace::client
