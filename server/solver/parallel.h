// Loops and reductions over the OpenMP team of the calling thread.
//
// The result never depends on the number of threads: blocks are fixed by the count alone, each block writes its own
// elements, and reductions combine the blocks' values in block order. An exception in a block is rethrown in the
// calling thread when the loop has ended.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <vector>

namespace headrace::solver {

// Threads that a loop may have, now or later: how much scratch is needed.
inline int max_threads() {
    return omp_get_max_threads();
}

// Threads that the loops of the calling thread take from now on, at most; 0: as many as they may have.
inline thread_local int team_limit = 0;
inline int team_size() {
    return team_limit > 0 ? std::min(team_limit, max_threads()) : max_threads();
}

// Elements a block of a plain loop over particles has: long enough to hide the loop's overhead.
inline constexpr std::size_t kParticleBlock = 1024;

// body(begin, end, thread) for each block of [0, count); thread < max_threads() names the scratch it may use.
template <class Body>
void parallel_for(std::size_t count, std::size_t block, Body&& body) {
    const auto blocks = static_cast<std::int64_t>((count + block - 1) / block);
    std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic) num_threads(team_size()) if (blocks > 1)
    for (std::int64_t b = 0; b < blocks; ++b) {
        try {
            const std::size_t begin = static_cast<std::size_t>(b) * block;
            body(begin, std::min(begin + block, count), omp_get_thread_num());
        } catch (...) {
#pragma omp critical(headrace_parallel_failure)
            failure = std::current_exception();
        }
    }
    if (failure) std::rethrow_exception(failure);
}

// combine(... combine(combine(start, map(block 0)), map(block 1)) ...): the same order for any number of threads.
template <class Value, class Map, class Combine>
Value parallel_reduce(std::size_t count, Value start, Map&& map, Combine&& combine) {
    std::vector<Value> partial((count + kParticleBlock - 1) / kParticleBlock, start);
    parallel_for(count, kParticleBlock,
                 [&](std::size_t begin, std::size_t end, int) { partial[begin / kParticleBlock] = map(begin, end); });
    Value result = start;
    for (const Value& value : partial) result = combine(result, value);
    return result;
}

}  // namespace headrace::solver
