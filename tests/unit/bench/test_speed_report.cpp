#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/bench/speed_report.h"

using namespace headrace;

TEST_CASE("SpeedReport.TableComesBackFromItsFile") {
    bench::SpeedRow row{"plain_3d", "plain", "clusters", 3, 1000, 2.4, 57.9, 2,  "AVX2",
                        100,        11.5,    1,          2, 3,    4,   180,  240};
    std::vector<bench::SpeedRow> rows;
    bench::put_row(rows, row, false);
    row.threads = 1;
    bench::put_row(rows, row, false);
    row.Mpsps_per_core = 9.0;
    bench::put_row(rows, row, true);  // slower: stays out
    const auto path = std::filesystem::temp_directory_path() / ("headrace_speed_" + std::to_string(getpid()) + ".csv");
    std::ofstream(path) << bench::speed_csv(rows);
    const std::vector<bench::SpeedRow> read = bench::read_speed_csv(path);
    std::filesystem::remove(path);
    REQUIRE(read.size() == 2);
    CHECK(read[1].Mpsps_per_core == 11.5);
    CHECK(bench::speed_csv(read) == bench::speed_csv(rows));
}
