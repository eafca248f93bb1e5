#include <catch2/catch.hpp>
#include <numeric>
#include <stdexcept>

#include "server/solver/parallel.h"

using namespace headrace::solver;

namespace {

template <class Work>
auto with_threads(int threads, Work&& work) {
    const int before = max_threads();
    omp_set_num_threads(threads);
    const auto result = work();
    omp_set_num_threads(before);
    return result;
}

// Values whose floating-point sum depends on the order.
double sum_of_inverses(std::size_t count) {
    return parallel_reduce(
        count, 0.0,
        [](std::size_t begin, std::size_t end) {
            double sum = 0.0;
            for (std::size_t i = begin; i < end; ++i) sum += 1.0 / (1.0 + static_cast<double>(i));
            return sum;
        },
        [](double a, double b) { return a + b; });
}

}  // namespace

TEST_CASE("Parallel.ForVisitsEachElementOnce") {
    for (const std::size_t count : {0u, 1u, 7u, 8u, 1000u}) {
        std::vector<int> visits(count, 0);
        parallel_for(count, 8, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        CHECK(std::accumulate(visits.begin(), visits.end(), 0) == static_cast<int>(count));
        CHECK(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
    }
}

TEST_CASE("Parallel.ReductionHasTheSameBitsForAnyThreadCount") {
    const double one = with_threads(1, [] { return sum_of_inverses(100000); });
    for (const int threads : {2, 3, 4}) CHECK(with_threads(threads, [] { return sum_of_inverses(100000); }) == one);
}

TEST_CASE("Parallel.ExceptionReachesTheCaller") {
    const auto fail = [](std::size_t begin, std::size_t, int) {
        if (begin == 500) throw std::runtime_error("block 5");
    };
    CHECK_THROWS_AS(parallel_for(1000, 100, fail), std::runtime_error);
}
