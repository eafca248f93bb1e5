#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "client/ordered_work.h"

using headrace::client::OrderedWork;

TEST_CASE("OrderedWork.ItemsComeInOrderWhoeverMadeThem") {
    for (const std::size_t workers : {1u, 2u, 5u}) {
        std::vector<OrderedWork<std::size_t>::Make> makers(workers, [](std::size_t index) { return 10 * index; });
        OrderedWork<std::size_t> work(100, makers);
        for (std::size_t k = 0; k < 100; ++k) REQUIRE(work.next() == 10 * k);
    }
}

TEST_CASE("OrderedWork.NoMoreThanTwoItemsAWorkerAreAheadOfTheTaker") {
    std::atomic<std::size_t> taken{0}, most{0};
    const auto make = [&](std::size_t index) {
        // What is taken only grows: the true lead at the item's beginning was not less than this one.
        const std::size_t lead = index - std::min<std::size_t>(index, taken);
        for (std::size_t seen = most; lead > seen && !most.compare_exchange_weak(seen, lead);) {
        }
        return index;
    };
    OrderedWork<std::size_t> work(200, {make, make, make});
    for (std::size_t k = 0; k < 200; ++k) {
        REQUIRE(work.next() == k);
        taken = k + 1;
    }
    // Item k + 6 begins when k + 1 items are taken, which is told here a moment later.
    CHECK(most <= 6);
}

TEST_CASE("OrderedWork.WhatAWorkerThrowsIsThrownAtItsTurn") {
    OrderedWork<int> work(3, {[](std::size_t index) {
                              if (index == 1) throw std::runtime_error("second");
                              return static_cast<int>(index);
                          }});
    CHECK(work.next() == 0);
    CHECK_THROWS_WITH(work.next(), "second");
    CHECK(work.next() == 2);
}

TEST_CASE("OrderedWork.StoppedWorkEndsWithTheItemsBegun") {
    OrderedWork<std::size_t> work(1'000'000, {[](std::size_t index) { return index; }});
    CHECK(work.next() == 0);
    const std::size_t count = work.stop();
    CHECK(count <= 3);  // one taken, two ahead
    for (std::size_t k = 1; k < count; ++k) CHECK(work.next() == k);
}
