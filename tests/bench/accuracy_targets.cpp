#include "tests/bench/accuracy_targets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>

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

}  // namespace

bool run_targets(const std::vector<std::string>& names, const validation::Settings& settings, const std::string& path) {
    const bool is_new = !std::ifstream(path);
    std::ofstream file(path, std::ios::app);
    const std::string head =
        "| case | metric | value | must | aim | verdict | particles | steps | wall [s] "
        "|\n|---|---|---|---|---|---|---|---|---|";
    std::cout << head << std::endl;
    if (is_new) file << head << std::endl;
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
        for (const validation::Measured& measured : outcome->metrics) {
            const std::string row = row_of(one, *outcome, measured, is_met);
            std::cout << row << std::endl;
            file << row << std::endl;
        }
    }
    return is_met;
}

}  // namespace headrace::bench
