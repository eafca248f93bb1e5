#include <catch2/catch.hpp>
#include <sstream>
#include <string>

#include "client/progress.h"

using namespace headrace::client;
using namespace std::chrono_literals;

namespace {

// A clock that stands still unless told otherwise.
struct Bench {
    Progress::Clock::time_point time{};
    std::ostringstream out;
    Progress make(bool is_terminal) {
        return Progress(out, is_terminal, "run", [this] { return time; });
    }
};

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("Progress.PipeGetsALinePerTenth") {
    Bench bench;
    Progress progress = bench.make(false);
    for (int k = 0; k <= 1'000; ++k) progress.update(k / 1'000.0, "t");
    progress.finish();
    CHECK(count(bench.out.str(), "\n") == 10);
    CHECK(bench.out.str().find("run 50 %") != std::string::npos);
    CHECK(bench.out.str().find_first_of("\r\x1b") == std::string::npos);
}

TEST_CASE("Progress.PipeGetsALineEveryFiveSecondsWithoutAnEnd") {
    Bench bench;
    Progress progress = bench.make(false);
    for (int k = 0; k < 100; ++k) {
        bench.time += 200ms;
        progress.update(std::nullopt, "t 1 s");
    }
    CHECK(count(bench.out.str(), "\n") == 4);  // 20 s
}

TEST_CASE("Progress.EstimateIsLinear") {
    Bench bench;
    Progress progress = bench.make(false);
    bench.time += 10s;
    progress.update(0.25, "t");
    CHECK(bench.out.str().find("ETA 0:30") != std::string::npos);  // 10 s for a quarter: 30 s for the rest
}

TEST_CASE("Progress.TerminalGetsOneBarThatGoes") {
    Bench bench;
    {
        Progress progress = bench.make(true);
        for (int k = 0; k <= 10; ++k) {
            bench.time += 1s;
            progress.update(k / 10.0, "t");
        }
    }
    CHECK(count(bench.out.str(), "\n") == 0);
    CHECK(bench.out.str().find("[############            ] 50 %") != std::string::npos);
    CHECK(bench.out.str().ends_with("\r\x1b[K"));
}
