// Samples of probes in recordings.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "proto/messages_json.h"
#include "proto/recording.h"
#include "tests/support/frame_samples.h"
#include "tests/support/recording_samples.h"

using namespace headrace::proto;
using namespace headrace::test;

namespace {

const std::vector<ProbeColumn> kPressure{{"pressure", "Pa", {}}};
const std::vector<ProbeColumn> kProfile{{"vx_0", "m/s", 0.0}, {"vx_1", "m/s", 0.5}};

// Instant k: a value of one probe, and on even ones of another.
ProbeSamples instant(int k) {
    ProbeSamples samples{0.1 * k, {{"P", kPressure, {1.0 / (k + 3)}}}};
    if (k % 2 == 0) samples.samples.push_back({"line", kProfile, {std::nullopt, 2.0}});
    return samples;
}

struct Flat {
    double time;
    std::string probe;
    std::vector<ProbeColumn> columns;
    ProbeRow values;
    bool operator==(const Flat&) const = default;
};
void append(std::vector<Flat>& all, const ProbeSamples& samples) {
    for (const ProbeSample& sample : samples.samples)
        all.push_back({samples.time, sample.probe, sample.columns, sample.values});
}

std::vector<Flat> read_all(const std::filesystem::path& file) {
    std::vector<Flat> all;
    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    REQUIRE((*reader)->read_probes([&](const ProbeSamples& samples) { append(all, samples); }));
    return all;
}

}  // namespace

TEST_CASE("RecordingProbes.ComeBackWithColumnsAndMissingValues") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    RecordingOptions options;
    options.compression = GENERATE(Compression::none, Compression::zstd);
    const bool is_finished = GENERATE(true, false);
    auto writer = RecordingWriter::create(file, kSampleMetadata, options);
    REQUIRE(writer);
    std::vector<Flat> expected;
    for (int k = 0; k < 6; ++k) {
        REQUIRE((*writer)->write_frame(make_sample_frame(static_cast<std::uint64_t>(k + 1))));
        REQUIRE((*writer)->write_probes(instant(k)));
        append(expected, instant(k));
    }
    // Another probe of the same name.
    const ProbeSamples other{0.7, {{"P", kProfile, {3.0, 4.0}}}};
    REQUIRE((*writer)->write_probes(other));
    append(expected, other);
    if (is_finished) REQUIRE((*writer)->finish());
    const auto found = read_all(file);
    CHECK(found == expected);
    CHECK((*RecordingReader::open(file))->frame_count() == 6);
}

TEST_CASE("RecordingProbes.ColumnsAreWrittenOnce") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    {
        auto writer = RecordingWriter::create(file, kSampleMetadata, {});
        for (int k = 0; k < 6; ++k) REQUIRE((*writer)->write_probes(instant(k)));
    }
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    std::size_t count = 0;
    for (std::size_t at = bytes.find("\"columns\""); at != std::string::npos; at = bytes.find("\"columns\"", at + 1))
        ++count;
    CHECK(count == 2);  // one for each of the two probes
}

TEST_CASE("RecordingProbes.TheTextIsPlain") {
    CHECK(probe_samples_text(instant(1)) ==
          R"({"time":0.1,"samples":[{"probe":"P","columns":[{"name":"pressure","unit":"Pa"}],"values":[0.25]}]})");
    CHECK(probe_samples_text({0.5, {{"line", {}, {std::nullopt, 2.0}}}}) ==
          R"({"time":0.5,"samples":[{"probe":"line","values":[null,2.0]}]})");
    CHECK_FALSE(parse_probe_samples(R"({"time":0.5,"samples":[{"probe":"line","values":["x"]}]})"));
}
