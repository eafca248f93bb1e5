#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>

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

TEST_CASE("Parallel.BlocksOfAShareAreTakenOnceFromBothEnds") {
    BlockShare share;
    share.assign(3, 7);
    CHECK(share.take_front() == 3);
    CHECK(share.take_back() == 6);
    CHECK(share.take_back() == 5);
    CHECK(share.take_front() == 4);
    CHECK(share.take_front() == -1);
    CHECK(share.take_back() == -1);
}

TEST_CASE("Parallel.ThreadsThatAreDoneHelpTheOthers") {
    // The first block ends when all others have: somebody else must do those of its thread.
    constexpr std::size_t kBlocks = 64;
    const int threads = GENERATE(2, 3, 4);
    with_threads(threads, [&] {
        std::atomic<std::size_t> done{0};
        bool is_helped = false;
        parallel_for(kBlocks, 1, [&](std::size_t block, std::size_t, int) {
            if (block == 0) {
                const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
                while (done < kBlocks - 1 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
                is_helped = done == kBlocks - 1;
            }
            ++done;
        });
        CHECK(is_helped);
        CHECK(done == kBlocks);
        return 0;
    });
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
