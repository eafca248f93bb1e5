#include <catch2/catch.hpp>
#include <random>

#include "server/solver/lanes.h"
#include "server/solver/smoothing_kernels.h"

using namespace headrace::solver;

namespace {

struct Numbers {
    alignas(64) double value[kLanes];
};

Numbers random_numbers(unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Numbers numbers{};
    for (double& value : numbers.value) value = uniform(random);
    return numbers;
}

}  // namespace

TEST_CASE("Lanes.DoToEachNumberWhatTheScalarFunctionsDo") {
    const Numbers a = random_numbers(1), b = random_numbers(2);
    const Lanes x = load_lanes(a.value), y = load_lanes(b.value);
    const Lanes one = splat<Lanes>(1.5), root = square_root(Lanes(x * x)), large = maximum<Lanes>(x, y),
                small = minimum<Lanes>(x, y), positive = positive_or_zero<Lanes>(x),
                chosen = less_or<Lanes>(x, y, x * 2.0, y * 3.0);
    for (std::size_t k = 0; k < kLanes; ++k) {
        CHECK(x[k] == a.value[k]);
        CHECK(one[k] == 1.5);
        CHECK(root[k] == square_root(a.value[k] * a.value[k]));
        CHECK(large[k] == maximum(a.value[k], b.value[k]));
        CHECK(small[k] == minimum(a.value[k], b.value[k]));
        CHECK(positive[k] == positive_or_zero(a.value[k]));
        CHECK(chosen[k] == less_or(a.value[k], b.value[k], a.value[k] * 2.0, b.value[k] * 3.0));
    }
}

TEST_CASE("Lanes.AreSummedInOneOrder") {
    // Powers that rounding would lose in another order: (0+4) + (2+6) + ((1+5) + (3+7)).
    alignas(64) const double numbers[kLanes] = {1e16, 3.0, 1.0, 5.0, -1e16, 7.0, 2.0, 9.0};
    CHECK(sum_lanes(load_lanes(numbers)) == 27.0);
    CHECK(sum_lanes(4.5) == 4.5);
}

TEST_CASE("Lanes.KernelsHaveTheValueOfOneNumber") {
    const WendlandC2<3> kernel(0.8);
    alignas(64) const double r[kLanes] = {0.0, 0.1, 0.25, 0.4, 0.6, 0.79, 0.8, 1e100};
    const Lanes W = kernel.W(load_lanes(r)), F = kernel.F(load_lanes(r));
    for (std::size_t k = 0; k < kLanes; ++k) {
        CHECK(W[k] == Approx(kernel.W(r[k])).epsilon(1e-15));
        CHECK(F[k] == Approx(kernel.F(r[k])).epsilon(1e-15));
    }
}
