#include "tests/bench/speed_compare.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>

#include "tests/bench/speed_report.h"

namespace headrace::bench {

namespace {

constexpr int kRounds = 3;  // of each build

// The arguments without those that this run replaces.
std::vector<std::string> find_shared(const std::vector<std::string>& arguments) {
    std::vector<std::string> shared;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        const std::string& word = arguments[k];
        if (word == "--compare" || word == "--out") {
            ++k;  // and its value
        } else if (!word.starts_with("--compare=") && !word.starts_with("--out=")) {
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

void print_ratios(const std::vector<SpeedRow>& own, const std::vector<SpeedRow>& others) {
    std::printf("\n%-20s %-10s %8s %5s %2s %-6s %9s %9s %7s\n", "case", "strategy", "N", "R/dp", "T", "isa", "this",
                "other", "ratio");
    for (const SpeedRow& row : own) {
        for (const SpeedRow& other : others) {
            if (!is_same_case(row, other)) continue;
            std::printf("%-20s %-10s %8zu %5.3g %2d %-6s %9.3f %9.3f %7.3f\n", row.name.c_str(), row.strategy.c_str(),
                        row.particles, row.support_over_dp, row.threads, row.isa.c_str(), row.Mpsps_per_core,
                        other.Mpsps_per_core, row.Mpsps_per_core / other.Mpsps_per_core);
        }
    }
}

}  // namespace

int compare_builds(const std::string& other, const std::vector<std::string>& arguments) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("headrace_compare_" + std::to_string(getpid()));
    const std::string programs[] = {fs::read_symlink("/proc/self/exe").string(), other};
    const fs::path tables[] = {folder / "this", folder / "other"};
    bool all_ran = true;
    for (int round = 0; round < kRounds; ++round) {
        for (int k = 0; k < 2; ++k) {
            std::vector<std::string> words = find_shared(arguments);
            words.insert(words.begin(), "speed");
            words.insert(words.end(), {"--keep-faster", "--out", tables[k].string()});
            all_ran = run_program(programs[k], words) && all_ran;
        }
    }
    print_ratios(read_speed_csv(tables[0] / "speed.csv"), read_speed_csv(tables[1] / "speed.csv"));
    fs::remove_all(folder);
    return all_ran ? 0 : 1;
}

}  // namespace headrace::bench
