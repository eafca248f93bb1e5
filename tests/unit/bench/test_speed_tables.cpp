#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <vector>

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
    const std::string folder = "tests/bench/results/";
    const auto files = bench::find_speed_files(std::string(HEADRACE_SOURCE_DIR) + "/" + folder);
    REQUIRE(std::find(files.begin(), files.end(), "speed.csv") != files.end());
    const std::string readme = content_of("README.md");
    for (const std::string& name : files) {
        INFO(name << "; made anew by headrace_bench speed --readme");
        const auto rows = bench::read_speed_csv(std::string(HEADRACE_SOURCE_DIR) + "/" + folder + name);
        REQUIRE_FALSE(rows.empty());
        CHECK(bench::with_speed_tables(readme, name, rows) == readme);
        CHECK(bench::speed_document(name, rows) == content_of(folder + name.substr(0, name.size() - 4) + ".md"));
    }
}

TEST_CASE("SpeedTables.StandBetweenTheirMarksAndLeaveTheRestAlone") {
    const std::string begin = bench::speed_begin("speed_a.csv"), end = bench::speed_end("speed_a.csv");
    const std::string other = bench::speed_begin("speed.csv") + "kept\n" + bench::speed_end("speed.csv");
    const std::vector<SpeedRow> rows{plain("clusters", "AVX-512", 1, 3.73)};
    const auto fresh = bench::with_speed_tables(other + begin + "old\n" + end + "after\n", "speed_a.csv", rows);
    REQUIRE(fresh.has_value());
    CHECK(fresh->starts_with(other + begin));
    CHECK(fresh->ends_with(end + "after\n"));
    CHECK(fresh->find("old") == std::string::npos);
    CHECK(fresh->find("| 3D | 3 | 112 | whole | 3.73 (248) |") != std::string::npos);
    CHECK(bench::with_speed_tables(*fresh, "speed_a.csv", rows) == fresh);
    CHECK_FALSE(bench::with_speed_tables("no marks", "speed_a.csv", {}).has_value());
    CHECK_FALSE(bench::with_speed_tables(begin, "speed_a.csv", {}).has_value());
    CHECK_FALSE(bench::with_speed_tables(begin + end, "speed_b.csv", {}).has_value());
}

// 3.5 of 4; two threads at 1.8 each are 3.6 of 4 as a whole, nine tenths; what was not measured has no column.
TEST_CASE("SpeedTables.CompareWithTheClustersOfOneThread") {
    const std::vector<SpeedRow> rows{plain("clusters", "AVX-512", 1, 4.0), plain("half", "AVX-512", 1, 5.0),
                                     plain("buffer", "AVX-512", 1, 3.5), plain("clusters", "AVX2", 1, 2.0),
                                     plain("clusters", "AVX-512", 2, 1.8)};
    const std::string document = bench::speed_document("speed.csv", rows);
    CHECK(document.find("| particles | half lists | buffer | AVX2 | two threads together |\n") != std::string::npos);
    CHECK(document.find("| 3D | 64,000 | 1.25 | 0.88 | 0.50 | 0.90 |\n") != std::string::npos);
    const std::string marks = bench::speed_begin("speed.csv") + bench::speed_end("speed.csv");
    const auto readme = bench::with_speed_tables(marks, "speed.csv", rows);
    REQUIRE(readme.has_value());
    CHECK(readme->find("| 3D | 3 | 112 | half | 5 (248) |") != std::string::npos);
    CHECK(document.find("| plain_3d | 64,000 | 3 | 4 (248) | 5 (248) | 3.5 (248) | - | half |") != std::string::npos);
}

// A size that lacks what another has shows a dash; one that has nothing but its clusters has no line.
TEST_CASE("SpeedTables.LeaveOutWhatWasNotMeasured") {
    std::vector<SpeedRow> rows{plain("clusters", "AVX2", 1, 1.0), plain("half", "AVX2", 1, 1.5),
                               plain("clusters", "SSE4", 1, 0.5)};
    const std::string without_sse4 = "| 3D | 1,000,000 | 1.25 | - |\n", heading = "| half lists | SSE4 |\n";
    SpeedRow large = plain("clusters", "AVX2", 1, 0.8);
    large.particles = 1000000;
    rows.push_back(large);
    CHECK(bench::speed_document("speed.csv", rows).find("| 3D | 1,000,000 | ") == std::string::npos);
    large.strategy = "half";
    large.Mpsps_per_core = 1.0;
    rows.push_back(large);
    const std::string document = bench::speed_document("speed.csv", rows);
    CHECK(document.find(heading) != std::string::npos);
    CHECK(document.find("| 3D | 64,000 | 1.50 | 0.50 |\n") != std::string::npos);
    CHECK(document.find(without_sse4) != std::string::npos);
    CHECK(document.find("Growth") == std::string::npos);
}

// 4 to 3.2 million a second is a quarter more time for a particle.
TEST_CASE("SpeedTables.TellHowTimeGrowsFromTheFewestParticles") {
    SpeedRow many = plain("clusters", "AVX2", 1, 3.2), few = plain("clusters", "AVX2", 1, 4.0);
    many.name = few.name = "growth_plain_3d";
    many.particles = 1000000;
    many.bytes_per_particle = 243.4;
    SpeedRow of_half_lists = many;  // has its own fewest
    of_half_lists.strategy = "half";
    SpeedRow on_two_threads = few;  // are of another table
    on_two_threads.threads = 2;
    const std::string document = bench::speed_document(
        "speed.csv", {many, few, of_half_lists, on_two_threads, plain("clusters", "AVX2", 1, 1.0)});
    CHECK(document.find("one thread, AVX2") != std::string::npos);
    CHECK(document.find("| plain | half | 1,000,000 | 3.2 (248) | 1.00 | 243 |\n") != std::string::npos);
    CHECK(document.find("| plain | whole | 1,000,000 | 3.2 (248) | 1.25 | 243 |\n") != std::string::npos);
    CHECK(document.find("| plain | whole | 64,000 | 4 (248) | 1.00 | 0 |\n") != std::string::npos);
}
