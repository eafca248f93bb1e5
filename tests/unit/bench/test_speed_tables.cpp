#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>

#include "tests/bench/speed_tables.h"

using namespace headrace;
using bench::SpeedRow;

namespace {

std::string content_of(const std::string& file) {
    std::ifstream in(std::string(HEADRACE_SOURCE_DIR) + "/" + file);
    return {std::istreambuf_iterator<char>(in), {}};
}

SpeedRow plain(const std::string& strategy, const std::string& isa, int threads, double Mpsps) {
    SpeedRow row;
    row.name = "plain_3d";
    row.model = "plain";
    row.strategy = strategy;
    row.dimensions = 3;
    row.particles = 64000;
    row.support_over_dp = 3.0;
    row.neighbours = 112.1;
    row.threads = threads;
    row.isa = isa;
    row.Mpsps_per_core = Mpsps;
    row.fma_gflops = 248.4;
    return row;
}

}  // namespace

TEST_CASE("SpeedTables.ReadmeHoldsWhatTheMeasurementsGive") {
    const auto rows = bench::read_speed_csv(std::string(HEADRACE_SOURCE_DIR) + "/tests/bench/results/speed.csv");
    REQUIRE_FALSE(rows.empty());
    const std::string readme = content_of("README.md");
    const auto fresh = bench::with_speed_tables(readme, rows);
    REQUIRE(fresh.has_value());
    INFO("made anew by headrace_bench speed --readme");
    CHECK(*fresh == readme);
    CHECK(bench::speed_document(rows) == content_of("tests/bench/results/speed.md"));
}

TEST_CASE("SpeedTables.StandBetweenTheirMarksAndLeaveTheRestAlone") {
    const std::string readme = std::string("before\n") + bench::kSpeedBegin + "old\n" + bench::kSpeedEnd + "after\n";
    const auto fresh = bench::with_speed_tables(readme, {plain("clusters", "AVX-512", 1, 3.73)});
    REQUIRE(fresh.has_value());
    CHECK(fresh->starts_with(std::string("before\n") + bench::kSpeedBegin));
    CHECK(fresh->ends_with(std::string(bench::kSpeedEnd) + "after\n"));
    CHECK(fresh->find("old") == std::string::npos);
    CHECK(fresh->find("| 3D | 3 | 112 | whole | 3.73 (248) |") != std::string::npos);
    CHECK(bench::with_speed_tables(*fresh, {plain("clusters", "AVX-512", 1, 3.73)}) == fresh);
    CHECK_FALSE(bench::with_speed_tables("no marks", {}).has_value());
    CHECK_FALSE(bench::with_speed_tables(bench::kSpeedBegin, {}).has_value());
}

// 3.5 of 4; two threads at 1.8 each are 3.6 of 4 as a whole, nine tenths; what was not measured has no figure.
TEST_CASE("SpeedTables.CompareWithTheClustersOfOneThread") {
    const std::vector<SpeedRow> rows{plain("clusters", "AVX-512", 1, 4.0), plain("half", "AVX-512", 1, 5.0),
                                     plain("buffer", "AVX-512", 1, 3.5), plain("clusters", "AVX2", 1, 2.0),
                                     plain("clusters", "AVX-512", 2, 1.8)};
    const std::string document = bench::speed_document(rows);
    CHECK(document.find("| 3D | 64,000 | 1.25 | 0.88 | - | 0.50 | - | - | 0.90 | - |") != std::string::npos);
    const auto readme = bench::with_speed_tables(std::string(bench::kSpeedBegin) + bench::kSpeedEnd, rows);
    CHECK(readme->find("| 3D | 3 | 112 | half | 5 (248) |") != std::string::npos);
    CHECK(document.find("| plain_3d | 64,000 | 3 | 4 (248) | 5 (248) | 3.5 (248) | - | half |") != std::string::npos);
}
