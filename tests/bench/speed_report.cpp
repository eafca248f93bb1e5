#include "tests/bench/speed_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "tests/bench/text.h"

namespace headrace::bench {

namespace {

constexpr const char* kHead =
    "case,model,strategy,dimensions,particles,support_over_dp,neighbours,threads,isa,steps,Mpsps_per_core,ns_sort,"
    "ns_list,ns_pair,ns_integrate,bytes_per_particle,fma_gflops,acoustic_steps,wall_per_simulated_s";

}  // namespace

std::string speed_table_head() {
    return text_of("%-20s %-7s %-10s %2s %8s %5s %5s %2s %-6s %7s %7s | %6s %6s %6s %6s | %6s %5s %8s", "case", "model",
                   "strategy", "D", "N", "R/dp", "nbrs", "T", "isa", "Mps/s", "acoust.", "sort", "list", "pair",
                   "integ", "B/N", "fma", "wall/s");
}

std::string speed_table_line(const SpeedRow& row) {
    return text_of(
        "%-20s %-7s %-10s %2d %8zu %5.3g %5.1f %2d %-6s %7.2f %7.2f | %6.1f %6.1f %6.1f %6.1f | %6.0f %5.0f %8.4g",
        row.name.c_str(), row.model.c_str(), row.strategy.c_str(), row.dimensions, row.particles, row.support_over_dp,
        row.neighbours, row.threads, row.isa.c_str(), row.Mpsps_per_core, row.Mpsps_per_core * row.acoustic_steps,
        row.ns_sort, row.ns_list, row.ns_pair, row.ns_integrate, row.bytes_per_particle, row.fma_gflops,
        row.wall_per_simulated_s);
}

std::string speed_csv(const std::vector<SpeedRow>& rows) {
    std::string text = std::string(kHead) + "\n";
    for (const SpeedRow& row : rows) {
        text += row.name + "," + row.model + "," + row.strategy;
        text += text_of(",%d,%zu,%.4g,%.1f,%d,", row.dimensions, row.particles, row.support_over_dp, row.neighbours,
                        row.threads);
        text += row.isa;
        text += text_of(",%d,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.3g,%.4g\n", row.steps, row.Mpsps_per_core,
                        row.ns_sort, row.ns_list, row.ns_pair, row.ns_integrate, row.bytes_per_particle, row.fma_gflops,
                        row.acoustic_steps, row.wall_per_simulated_s);
    }
    return text;
}

std::vector<SpeedRow> read_speed_csv(const std::string& path) {
    std::vector<SpeedRow> rows;
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    if (line != kHead) return rows;
    while (std::getline(file, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream words(line);
        SpeedRow row;
        words >> row.name >> row.model >> row.strategy >> row.dimensions >> row.particles >> row.support_over_dp >>
            row.neighbours >> row.threads >> row.isa >> row.steps >> row.Mpsps_per_core >> row.ns_sort >> row.ns_list >>
            row.ns_pair >> row.ns_integrate >> row.bytes_per_particle >> row.fma_gflops >> row.acoustic_steps >>
            row.wall_per_simulated_s;
        if (words) rows.push_back(row);
    }
    return rows;
}

bool is_same_case(const SpeedRow& a, const SpeedRow& b) {
    return a.name == b.name && a.model == b.model && a.strategy == b.strategy && a.particles == b.particles &&
           std::abs(a.support_over_dp - b.support_over_dp) < 0.005 &&  // the file has four digits
           a.threads == b.threads && a.isa == b.isa;
}

void put_row(std::vector<SpeedRow>& rows, const SpeedRow& row, bool keep_faster) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const SpeedRow& other) { return is_same_case(row, other); });
    if (found == rows.end()) {
        rows.push_back(row);
    } else if (!keep_faster || row.Mpsps_per_core > found->Mpsps_per_core) {
        *found = row;
    }
}

}  // namespace headrace::bench
