#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <random>

#include "server/solver/lanes.h"
#include "server/solver/smoothing_kernels.h"

using namespace headrace::solver;

namespace {

using Eight = Lanes<double, 8>;
constexpr std::size_t kLanes = Eight::kCount;

struct Numbers {
    alignas(64) double value[kLanes];
    Eight lanes() const {
        Eight lanes;
        std::memcpy(&lanes.v, value, sizeof value);
        return lanes;
    }
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
    const Eight x = a.lanes(), y = b.lanes();
    const Eight one = splat<Eight>(1.5), large = maximum<Eight>(x, y), small = minimum<Eight>(x, y),
                positive = positive_or_zero(x), chosen = less_or(x, y, x * 2.0, 3.0 * y),
                quotient = (x - y) / (x + 2.0);
    for (std::size_t k = 0; k < kLanes; ++k) {
        CHECK(x[k] == a.value[k]);
        CHECK(one[k] == 1.5);
        CHECK(large[k] == std::max(a.value[k], b.value[k]));
        CHECK(small[k] == std::min(a.value[k], b.value[k]));
        CHECK(positive[k] == std::max(a.value[k], 0.0));
        CHECK(chosen[k] == (a.value[k] < b.value[k] ? a.value[k] * 2.0 : b.value[k] * 3.0));
        CHECK(quotient[k] == (a.value[k] - b.value[k]) / (a.value[k] + 2.0));
    }
}

TEST_CASE("Lanes.OfFloatsRoundEachOperation") {
    const Lanes<float, 4> third = Lanes<float, 4>(1.0) / 3.0;
    for (std::size_t k = 0; k < 4; ++k) CHECK(third[k] == 1.0f / 3.0f);
    CHECK(tiny<Lanes<float, 4>>()[0] > 0.0f);
}

TEST_CASE("Lanes.KernelsHaveTheValueOfOneNumber") {
    const WendlandC2<3> kernel(0.8);
    const Numbers r{{0.0, 0.1, 0.25, 0.4, 0.6, 0.79, 0.8, 1e100}};
    const Eight W = kernel.W(r.lanes()), F = kernel.F(r.lanes());
    for (std::size_t k = 0; k < kLanes; ++k) {
        CHECK(W[k] == Approx(kernel.W(r.value[k])).epsilon(1e-15));
        CHECK(F[k] == Approx(kernel.F(r.value[k])).epsilon(1e-15));
    }
}
