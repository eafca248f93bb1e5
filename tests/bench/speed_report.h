// The figures of `headrace_bench speed`: table and CSV.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace headrace::bench {

// One case, size, strategy, thread count and instruction set. A particle-step is a full step of one particle.
struct SpeedRow {
    std::string name, model, strategy;
    int dimensions{};
    std::size_t particles{};
    double support_over_dp{};
    double neighbours{};  // mean within the support, the particle itself not counted
    int threads{};
    std::string isa;
    int steps{};  // timed ones
    double Mpsps_per_core{};
    double ns_sort{}, ns_list{}, ns_pair{}, ns_integrate{};  // [ns] per particle-step, times threads
    double bytes_per_particle{};
    double fma_gflops{};            // [GFLOP/s] per core beside it
    double acoustic_steps{1.0};     // mean in a full step
    double wall_per_simulated_s{};  // 0: the case stands for no time
};

std::string speed_table_head();
std::string speed_table_line(const SpeedRow& row);

std::string speed_csv(const std::vector<SpeedRow>& rows);
// Lines of such a file; none where there is no file.
std::vector<SpeedRow> read_speed_csv(const std::string& path);

// Do both stand for the same measurement?
bool is_same_case(const SpeedRow& a, const SpeedRow& b);
// Puts the row in the place of the one it repeats, or at the end. keep_faster: only where it is faster.
void put_row(std::vector<SpeedRow>& rows, const SpeedRow& row, bool keep_faster);

}  // namespace headrace::bench
