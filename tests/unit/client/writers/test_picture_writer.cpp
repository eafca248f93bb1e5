#include <catch2/catch.hpp>

#include "client/writers/contact_sheet.h"
#include "client/writers/writer.h"
#include "tests/unit/client/writers/synthetic.h"

using namespace headrace;
using namespace headrace::client;
using namespace headrace::tests;
using proto::Field;

// Read by the leak sanitizer: fontconfig, below cairo's text, keeps what it has parsed until the process ends.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libfontconfig";
}

namespace {

WriterOptions small_pictures(const TemporaryFolder& folder) {
    WriterOptions options;
    options.folder = folder.path();
    options.stem = "wave";
    options.scene = tank_scene();
    options.picture.width = 320;
    options.picture.height = 180;
    options.picture.sheet_frames = 3;
    return options;
}

SyntheticFrame one_particle(double time) {
    SyntheticFrame frame(3, 1, time);
    frame.column<float>(Field::position, "<f4", 3, {0.1f, 0.1f, 0.1f})
        .column<float>(Field::velocity, "<f4", 3, {1, 2, 2});
    return frame;
}

// Width and height from a PNG's header chunk: big-endian at bytes 16 and 20.
std::pair<int, int> png_size(const std::filesystem::path& file) {
    const std::string bytes = read_text(file);
    REQUIRE(bytes.size() > 24);
    REQUIRE(bytes.substr(1, 3) == "PNG");
    const auto number = [&](std::size_t at) {
        int value = 0;
        for (std::size_t k = at; k < at + 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
        return value;
    };
    return {number(16), number(20)};
}

std::vector<std::size_t> frames_on_sheet(std::size_t cells, std::size_t expected, std::size_t written) {
    ContactSheet sheet(cells, expected);
    for (std::size_t frame = 0; frame < written; ++frame)
        if (sheet.wants(frame)) sheet.add(frame, Image(8, 8, {}), "");
    return sheet.chosen_frames();
}

}  // namespace

TEST_CASE("PictureWriter.EveryFrameBecomesAPictureOfTheWantedSize") {
    TemporaryFolder folder;
    WriterOptions options = small_pictures(folder);
    options.expected_frames = 5;
    auto writer = make_writer("png", options);
    REQUIRE(writer.ok());
    for (int k = 0; k < 5; ++k)
        REQUIRE((*writer)->write(one_particle(0.01 * k).view(), at_rest(options.scene.objects)).ok());
    REQUIRE((*writer)->finish().ok());
    CHECK(png_size(folder / "wave_000000.png") == std::pair{320, 180});
    CHECK(png_size(folder / "wave_000004.png") == std::pair{320, 180});
    CHECK_FALSE(std::filesystem::exists(folder / "wave_000005.png"));
    CHECK(std::filesystem::exists(folder / "wave_sheet.png"));
    CHECK((*writer)->summary().find("wave_sheet.png") != std::string::npos);
}

TEST_CASE("PictureWriter.OnlyTheSheetWhenAskedFor") {
    TemporaryFolder folder;
    WriterOptions options = small_pictures(folder);
    options.picture.every_frame = false;
    auto writer = make_writer("png", options);
    for (int k = 0; k < 4; ++k) REQUIRE((*writer)->write(one_particle(0.01 * k).view(), {}).ok());
    REQUIRE((*writer)->finish().ok());
    std::vector<std::string> files;
    for (const auto& file : std::filesystem::directory_iterator(folder.path()))
        files.push_back(file.path().filename().string());
    CHECK(files == std::vector<std::string>{"wave_sheet.png"});
}

TEST_CASE("PictureWriter.MissingColourFieldIsNamed") {
    TemporaryFolder folder;
    WriterOptions options = small_pictures(folder);
    options.picture.color_field = Field::pressure;
    auto writer = make_writer("png", options);
    const auto written = (*writer)->write(one_particle(0).view(), {});
    REQUIRE_FALSE(written.ok());
    CHECK(written.error().code == proto::ErrorCode::invalid_params);
    CHECK(written.error().message.find("pressure") != std::string::npos);
}

TEST_CASE("PictureWriter.NonsenseOptionsAreRefused") {
    TemporaryFolder folder;
    WriterOptions options = small_pictures(folder);
    options.picture.color_min = 2;
    options.picture.color_max = 1;
    CHECK_FALSE(make_writer("png", options).ok());
    options = small_pictures(folder);
    options.picture.width = 1;
    CHECK_FALSE(make_writer("png", options).ok());
}

TEST_CASE("PictureWriter.ARecordingWithoutFramesLeavesNoSheet") {
    TemporaryFolder folder;
    auto writer = make_writer("png", small_pictures(folder));
    CHECK((*writer)->finish().ok());
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("ContactSheet.FramesAreEvenlySpreadAndBothEndsShown") {
    CHECK(frames_on_sheet(3, 101, 101) == std::vector<std::size_t>{0, 50, 100});
    CHECK(frames_on_sheet(12, 240, 240).size() == 12);
    CHECK(frames_on_sheet(12, 240, 240).front() == 0);
    CHECK(frames_on_sheet(12, 240, 240).back() == 239);
    CHECK(frames_on_sheet(12, 5, 5) == std::vector<std::size_t>{0, 1, 2, 3, 4});
    CHECK(frames_on_sheet(1, 5, 5) == std::vector<std::size_t>{4});
    CHECK(frames_on_sheet(0, 5, 5).empty());
}

TEST_CASE("ContactSheet.AShortRecordingShowsWhatThereIs") {
    CHECK(frames_on_sheet(3, 101, 60) == std::vector<std::size_t>{0, 50});
}

TEST_CASE("ContactSheet.AnUnknownNumberOfFramesIsSpreadToo") {
    for (const std::size_t written : {1u, 7u, 12u, 25u, 100u, 1000u}) {
        const auto frames = frames_on_sheet(12, 0, written);
        INFO(written << " frames written");
        CHECK(frames.size() == std::min<std::size_t>(12, written));
        CHECK(frames.front() == 0);
        // Kept frames are between written / 24 and written / 12 apart.
        CHECK(frames.back() + written / 12 + 1 >= written);
    }
}
