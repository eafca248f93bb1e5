// The figures of `headrace_bench strategies`: table, CSV and diagrams.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/solver/isa.h"
#include "tests/bench/strategy_sums.h"

namespace headrace::bench {

// One strategy at one size and thread count.
struct StrategyRow {
    Strategy strategy{};
    int dimensions{};
    std::size_t particles{};
    double support_over_dp{};
    double neighbours{};  // mean, the particle itself not counted
    int threads{};
    solver::Isa isa{};
    int steps{};           // per window
    double ms_per_step{};  // [ms] of the fastest window

    double Mpsps_per_core() const { return static_cast<double>(particles) / (ms_per_step * 1e3) / threads; }
};

std::string strategies_table_head();
std::string strategies_table_line(const StrategyRow& row);
std::string strategies_csv(const std::vector<StrategyRow>& rows);
// The lines of such a file that can be read; none where there is no file.
std::vector<StrategyRow> read_strategies_csv(const std::string& path);

// strategies_particles.png and strategies_threads.png in `folder`, a panel for each dimension and support. Without
// gnuplot, or where there is only one thread count to show, says so and draws nothing. False: gnuplot failed.
bool draw_strategies(const std::vector<StrategyRow>& rows, const std::string& folder);

}  // namespace headrace::bench
