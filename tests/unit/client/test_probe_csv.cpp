#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <string>

#include "client/probe_csv.h"
#include "tests/support/recording_samples.h"

using namespace headrace;
using namespace headrace::client;

namespace {

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

const std::vector<proto::ProbeColumn> kLevel{{"level", "m", {}}};
const std::vector<proto::ProbeColumn> kProfile{{"vx_0", "m/s", 0.0}, {"vx_1", "m/s", 0.25}};

}  // namespace

TEST_CASE("ProbeCsv.HeaderHasUnitsAndPlaces") {
    CHECK(csv_header({{"time", "s", {}}, {"mean_error", "1", {}}, {"vx_3", "m/s", 0.3}}) ==
          "time [s],mean_error,vx_3 at 0.3 m [m/s]\n");
    CHECK(csv_row({0.1, std::nullopt, 1.0 / 3.0}) == "0.1,,0.3333333333333333\n");
}

TEST_CASE("ProbeCsv.EachProbeOfARecordingGetsAFile") {
    const test::TemporaryFolder folder;
    const auto file = folder.path / "run.mcap";
    {
        auto writer = proto::RecordingWriter::create(file, test::kSampleMetadata, {});
        REQUIRE((*writer)->write_probes({0.0, {{"gauge", kLevel, {0.5}}, {"line", kProfile, {1.0, std::nullopt}}}}));
        REQUIRE((*writer)->write_probes({0.1, {{"gauge", kLevel, {0.25}}}}));
        // Replaced by another probe of its name.
        REQUIRE((*writer)->write_probes({0.2, {{"gauge", kProfile, {3.0, 4.0}}}}));
    }
    auto reader = proto::RecordingReader::open(file);
    REQUIRE(reader);
    const auto names = write_probe_files(**reader, {folder.path / "out", "run", {}, {}});
    REQUIRE(names);
    CHECK(names->size() == 3);
    CHECK(text_of(folder.path / "out" / "run_probe_gauge.csv") == "time [s],level [m]\n0,0.5\n0.1,0.25\n");
    CHECK(text_of(folder.path / "out" / "run_probe_gauge_2.csv") ==
          "time [s],vx_0 at 0 m [m/s],vx_1 at 0.25 m [m/s]\n0.2,3,4\n");
    CHECK(text_of(folder.path / "out" / "run_probe_line.csv") ==
          "time [s],vx_0 at 0 m [m/s],vx_1 at 0.25 m [m/s]\n0,1,\n");

    REQUIRE(write_probe_files(**reader, {folder.path / "part", "run", 0.1, 0.1}));
    CHECK(text_of(folder.path / "part" / "run_probe_gauge.csv") == "time [s],level [m]\n0.1,0.25\n");
    const auto none = write_probe_files(**reader, {folder.path / "none", "run", 5.0, {}});
    REQUIRE_FALSE(none);
    CHECK_FALSE(none.error().hint.empty());
}
