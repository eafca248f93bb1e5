#include <catch2/catch.hpp>

#include "client/convert.h"
#include "tests/support/recording_samples.h"

using namespace headrace;
using namespace headrace::client;

namespace {

constexpr const char* kScene = R"({"headrace_scene": 1, "name": "box", "dimensions": 3, "model": "thesis",
    "spacing": 0.1, "domain": {"min": [0, 0, 0], "max": [20, 20, 20]},
    "fluids": [{"name": "block", "shape": {"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}}]})";
constexpr const char* kLostMotion = R"([{"name": "lid", "role": "obstacle",
    "shape": {"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}, "motion": {"displacement": [0, "lift*t", 0]}}])";

void write_frames(const std::filesystem::path& file, const std::string& objects) {
    proto::RecordingMetadata metadata = test::kSampleMetadata;
    metadata.scene_json = kScene;
    metadata.objects_json = objects;
    auto writer = proto::RecordingWriter::create(file, metadata, {});
    REQUIRE(writer);
    for (const std::uint64_t seq : {1, 2}) REQUIRE((*writer)->write_frame(test::make_sample_frame(seq)));
    REQUIRE((*writer)->finish());
}

}  // namespace

// A motion may refer to what this program does not know: particles are particles all the same.
TEST_CASE("Convert.AMotionThatCannotBeEvaluatedMattersWhereObjectsAreShown") {
    const test::TemporaryFolder folder;
    ConvertOptions options;
    options.recording = folder.path / "run.mcap";
    options.folder = folder.path / "out";
    write_frames(options.recording, kLostMotion);

    options.formats = {"csv", "csv-long", "npz", "ply"};
    const auto particles = convert(options);
    if (!particles) FAIL(particles.error().path << ": " << particles.error().message);
    CHECK(particles->frames == 2);

    for (const char* format : {"vtp", "png", "pov"}) {
        options.formats = {"csv", format};
        const auto shown = convert(options);
        REQUIRE_FALSE(shown.ok());
        CHECK(shown.error().path == "objects[0].motion.displacement[1]");
    }
}
