#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/bench/accuracy_targets.h"

using namespace headrace;

TEST_CASE("AccuracyTargets.ACaseTakesThePlaceOfItsEarlierRows") {
    const auto path = std::filesystem::temp_directory_path() / ("headrace_targets_" + std::to_string(getpid()) + ".md");
    const std::string kept = "| balance | momentum | 0.004 | - | - | - | 600 | 143 | 0.3 |\n";
    std::ofstream(path) << "| case |\n|---|\n" << kept << "| free_fall | way | 1 | - | - | - | 1 | 1 | 1.0 |\n";
    validation::Settings settings;
    settings.resolution = 10;
    const bool is_met = bench::run_targets({"free_fall"}, settings, path);
    std::ifstream file(path);
    const std::string table{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(path);
    CHECK(is_met);
    CHECK(table.find("| free_fall | way | 1 |") == std::string::npos);
    const std::size_t fresh = table.find("| free_fall | way | ");
    REQUIRE(fresh != std::string::npos);
    CHECK(table.find("| free_fall | way | ", fresh + 1) == std::string::npos);
    CHECK(table.ends_with(kept));  // the cases' order
}
