#include "tests/bench/speed_compare.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>

#include "tests/bench/speed_report.h"

namespace headrace::bench {

namespace {

constexpr const char* kReplaced[] = {"--compare", "--out", "--name", "--rounds"};

// The arguments without those that this run replaces, and their values.
std::vector<std::string> find_shared(const std::vector<std::string>& arguments) {
    std::vector<std::string> shared;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        const std::string& word = arguments[k];
        const auto is = [&](const char* option) { return word == option; };
        const auto is_set = [&](const char* option) { return word.starts_with(std::string(option) + "="); };
        if (std::any_of(std::begin(kReplaced), std::end(kReplaced), is)) {
            ++k;
        } else if (std::none_of(std::begin(kReplaced), std::end(kReplaced), is_set)) {
            shared.push_back(word);
        }
    }
    return shared;
}

// Runs a program to its end. Did it succeed?
bool run_program(const std::string& program, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> words;
    for (std::string& word : arguments) words.push_back(word.data());
    words.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        execv(program.c_str(), words.data());
        _exit(127);
    }
    int status = 0;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// A case in all rounds.
struct Comparison {
    SpeedRow row;                // of this build's fastest round
    double other{};              // [M particle-steps/s per core] the other's fastest round
    std::vector<double> ratios;  // this over the other, round by round
};

void add_round(std::vector<Comparison>& cases, const std::vector<SpeedRow>& own, const std::vector<SpeedRow>& others) {
    for (const SpeedRow& row : own) {
        for (const SpeedRow& other : others) {
            if (!is_same_case(row, other)) continue;
            auto one = std::find_if(cases.begin(), cases.end(),
                                    [&](const Comparison& known) { return is_same_case(known.row, row); });
            if (one == cases.end()) one = cases.insert(cases.end(), {row, other.Mpsps_per_core, {}});
            if (row.Mpsps_per_core > one->row.Mpsps_per_core) one->row = row;
            one->other = std::max(one->other, other.Mpsps_per_core);
            one->ratios.push_back(row.Mpsps_per_core / other.Mpsps_per_core);
        }
    }
}

void print_ratios(std::vector<Comparison>& cases) {
    std::printf("\n%-20s %-10s %8s %5s %2s %-6s %9s %9s %7s %7s %7s\n", "case", "strategy", "N", "R/dp", "T", "isa",
                "this", "other", "least", "median", "most");
    for (Comparison& one : cases) {
        std::sort(one.ratios.begin(), one.ratios.end());
        const std::size_t n = one.ratios.size();
        const double median = 0.5 * (one.ratios[(n - 1) / 2] + one.ratios[n / 2]);
        const SpeedRow& row = one.row;
        std::printf("%-20s %-10s %8zu %5.3g %2d %-6s %9.3f %9.3f %7.3f %7.3f %7.3f\n", row.name.c_str(),
                    row.strategy.c_str(), row.particles, row.support_over_dp, row.threads, row.isa.c_str(),
                    row.Mpsps_per_core, one.other, one.ratios.front(), median, one.ratios.back());
    }
}

}  // namespace

int compare_builds(const std::string& other, int rounds, const std::vector<std::string>& arguments) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("headrace_compare_" + std::to_string(getpid()));
    const std::string programs[] = {fs::read_symlink("/proc/self/exe").string(), other};
    bool all_ran = true;
    std::vector<Comparison> cases;
    for (int round = 0; round < rounds; ++round) {
        std::vector<SpeedRow> rows[2];
        for (const int turn : {0, 1}) {
            const int k = (round + turn) % 2;  // each is first as often as second
            const fs::path table = folder / std::to_string(2 * round + k);
            std::vector<std::string> words = find_shared(arguments);
            words.insert(words.begin(), "speed");
            words.insert(words.end(), {"--out", table.string()});
            all_ran = run_program(programs[k], words) && all_ran;
            rows[k] = read_speed_csv(table / "speed.csv");
        }
        add_round(cases, rows[0], rows[1]);
    }
    print_ratios(cases);
    fs::remove_all(folder);
    return all_ran ? 0 : 1;
}

}  // namespace headrace::bench
