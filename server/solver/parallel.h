// Loops and reductions over the OpenMP team of the calling thread.
//
// Every thread has a share of the blocks that follow one another, the same in all loops of the same count: what it
// reads is mostly what it wrote before, and lies in its own cache and memory. One that is done helps the others, from
// their ends: blocks that cost more than others, at walls or where neighbours are many, are balanced by what they take.
//
// The result never depends on the number of threads: blocks are fixed by the count alone, each block writes its own
// elements, and reductions combine the blocks' values in block order. An exception in a block is rethrown in the
// calling thread when the loop has ended.
#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
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

// A thread's share of the blocks of a loop.
class alignas(64) BlockShare {  // a cache line each: threads count down their own
  public:
    void assign(std::uint32_t begin, std::uint32_t end) { left_.store(pack(begin, end), std::memory_order_relaxed); }
    // The next block from its front (its owner) or its back; -1: none is left.
    std::int64_t take_front() {
        return take([](std::uint32_t begin, std::uint32_t end) { return pack(begin + 1, end); }, false);
    }
    std::int64_t take_back() {
        return take([](std::uint32_t begin, std::uint32_t end) { return pack(begin, end - 1); }, true);
    }

  private:
    static std::uint64_t pack(std::uint32_t begin, std::uint32_t end) { return std::uint64_t{begin} << 32 | end; }
    template <class Rest>
    std::int64_t take(Rest&& rest, bool is_last) {
        std::uint64_t left = left_.load(std::memory_order_relaxed);
        for (;;) {
            const auto begin = static_cast<std::uint32_t>(left >> 32), end = static_cast<std::uint32_t>(left);
            if (begin >= end) return -1;
            if (left_.compare_exchange_weak(left, rest(begin, end), std::memory_order_relaxed))
                return is_last ? end - 1 : begin;
        }
    }

    std::atomic<std::uint64_t> left_{};  // [begin, end): 32 bits each
};

// work(block, thread) for each of so many blocks, less than 2^32; must not throw.
template <class Work>
void share_blocks(std::size_t blocks, int team, Work&& work) {
    const auto threads = static_cast<std::size_t>(team);
    std::vector<BlockShare> shares(threads);
    for (std::size_t t = 0; t < threads; ++t) {
        shares[t].assign(static_cast<std::uint32_t>(blocks * t / threads),
                         static_cast<std::uint32_t>(blocks * (t + 1) / threads));
    }
#pragma omp parallel num_threads(team)
    {
        // There may be fewer threads than shares.
        const int thread = omp_get_thread_num();
        for (std::size_t k = 0; k < threads; ++k) {
            BlockShare& share = shares[(static_cast<std::size_t>(thread) + k) % threads];
            for (;;) {
                const std::int64_t b = k == 0 ? share.take_front() : share.take_back();
                if (b < 0) break;
                work(static_cast<std::size_t>(b), thread);
            }
        }
    }
}

// body(begin, end, thread) for each block of [0, count); thread < max_threads() names the scratch it may use.
template <class Body>
void parallel_for(std::size_t count, std::size_t block, Body&& body) {
    const std::size_t blocks = (count + block - 1) / block;
    const auto do_block = [&](std::size_t b, int thread) { body(b * block, std::min((b + 1) * block, count), thread); };
    const int team = team_size();
    if (team == 1 || blocks <= 1 || omp_in_parallel() != 0) {
        for (std::size_t b = 0; b < blocks; ++b) do_block(b, omp_get_thread_num());
        return;
    }
    std::exception_ptr failure;
    share_blocks(blocks, team, [&](std::size_t b, int thread) {
        try {
            do_block(b, thread);
        } catch (...) {
#pragma omp critical(headrace_parallel_failure)
            failure = std::current_exception();
        }
    });
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
