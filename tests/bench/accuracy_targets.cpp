#include "tests/bench/accuracy_targets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>

namespace headrace::bench {

namespace {

// "-": the case states none for this metric.
std::string row_of(const validation::Case& one, const validation::Outcome& outcome,
                   const validation::Measured& measured, bool& is_met) {
    const auto target = std::find_if(one.targets.begin(), one.targets.end(),
                                     [&](const auto& candidate) { return candidate.metric == measured.metric; });
    char limits[64] = "- | - | -";
    if (target != one.targets.end()) {
        const bool must = measured.value <= target->must, aim = measured.value <= target->aim;
        std::snprintf(limits, sizeof limits, "%.3g | %.3g | %s", target->must, target->aim,
                      aim    ? "aim"
                      : must ? "must"
                             : "missed");
        is_met = is_met && must;
    }
    if (measured.metric == "leaked") {
        std::snprintf(limits, sizeof limits, "0 | 0 | %s", measured.value == 0.0 ? "aim" : "missed");
        is_met = is_met && measured.value == 0.0;
    }
    char text[256];
    std::snprintf(text, sizeof text, "| %s | %s | %.3g | %s | %zu | %zu | %.1f |", one.name.c_str(),
                  measured.metric.c_str(), measured.value, limits, outcome.particles, outcome.steps, outcome.wall);
    return text;
}

constexpr const char* kHead =
    "| case | metric | value | must | aim | verdict | particles | steps | wall [s] "
    "|\n|---|---|---|---|---|---|---|---|---|\n";

// The table's rows by case; none where there is no file.
std::map<std::string, std::string> read_rows(const std::string& path) {
    std::map<std::string, std::string> rows;
    std::ifstream file(path);
    std::string line;
    for (int k = 0; std::getline(file, line); ++k)
        if (k >= 2 && line.starts_with("| ")) rows[line.substr(2, line.find(' ', 2) - 2)] += line + "\n";
    return rows;
}

bool write_rows(const std::map<std::string, std::string>& rows, const std::string& path) {
    std::ofstream file(path);
    file << kHead;
    for (const validation::Case& one : validation::cases())
        if (const auto found = rows.find(one.name); found != rows.end()) file << found->second;
    return static_cast<bool>(file.flush());
}

}  // namespace

bool run_targets(const std::vector<std::string>& names, const validation::Settings& settings, const std::string& path) {
    std::map<std::string, std::string> rows = read_rows(path);
    std::cout << kHead << std::flush;
    bool is_met = true;
    for (const validation::Case& one : validation::cases()) {
        const bool is_named = std::find(names.begin(), names.end(), one.name) != names.end();
        if (names.empty() ? one.is_long : !is_named) continue;
        const auto outcome = validation::run_case(one, settings);
        if (!outcome) {
            std::cerr << "headrace_bench: " << one.name << ": " << outcome.error().message << '\n';
            is_met = false;
            continue;
        }
        if (!outcome->fault.empty()) std::cerr << one.name << ": " << outcome->fault << '\n';
        std::string& own = rows[one.name];
        own.clear();
        for (const validation::Measured& measured : outcome->metrics)
            own += row_of(one, *outcome, measured, is_met) + "\n";
        std::cout << own << std::flush;
        if (!write_rows(rows, path)) {
            std::cerr << "headrace_bench: cannot write " << path << '\n';
            return false;
        }
    }
    return is_met;
}

}  // namespace headrace::bench
