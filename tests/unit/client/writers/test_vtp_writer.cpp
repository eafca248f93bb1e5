// The .vtp files are read back here by following their own offsets; tests/support/check_vtp.py does it with real VTK.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "client/writers/writer.h"
#include "tests/unit/client/writers/synthetic.h"

using namespace headrace;
using namespace headrace::tests;
using client::make_writer;
using client::WriterOptions;
using proto::Field;

namespace {

// One array of a file: what the XML says and the bytes at the place it names.
struct FoundArray {
    std::string type;
    int components{};
    std::string bytes;

    template <class T>
    std::vector<T> values() const {
        std::vector<T> result(bytes.size() / sizeof(T));
        std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
        return result;
    }
};

// Value of an attribute within one XML tag; empty when it has none of that name.
std::string attribute(const std::string& tag, const std::string& name) {
    const std::size_t start = tag.find(" " + name + "=\"");
    if (start == std::string::npos) return "";
    const std::size_t value = start + name.size() + 3;
    return tag.substr(value, tag.find('"', value) - value);
}

// The tags of an XML text, without their angle brackets.
std::vector<std::string> tags_of(const std::string& xml) {
    std::vector<std::string> tags;
    for (std::size_t open = xml.find('<'); open != std::string::npos; open = xml.find('<', open + 1))
        tags.push_back(xml.substr(open + 1, xml.find('>', open) - open - 1));
    return tags;
}

// Arrays by name; those of cells as "Verts/offsets". Checks that the arrays fill the appended block without gaps.
std::map<std::string, FoundArray> read_vtp(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    const std::string mark = "<AppendedData encoding=\"raw\">\n_";
    const std::size_t start = text.find(mark) + mark.size();
    REQUIRE(start > mark.size());

    std::map<std::string, FoundArray> arrays;
    std::string prefix;
    std::size_t next = 0;
    for (const std::string& tag : tags_of(text.substr(0, start))) {
        if (tag == "Verts" || tag == "Lines" || tag == "Polys") prefix = tag + "/";
        if (tag.starts_with("/") && !prefix.empty()) prefix.clear();
        if (!tag.starts_with("DataArray")) continue;
        const std::size_t offset = std::stoul(attribute(tag, "offset"));
        CHECK(offset == next);
        std::uint64_t size = 0;
        REQUIRE(start + offset + sizeof size <= text.size());
        std::memcpy(&size, text.data() + start + offset, sizeof size);
        REQUIRE(start + offset + sizeof size + size <= text.size());
        arrays[prefix + attribute(tag, "Name")] = {attribute(tag, "type"),
                                                   std::stoi(attribute(tag, "NumberOfComponents")),
                                                   text.substr(start + offset + sizeof size, size)};
        next = offset + sizeof size + size;
    }
    CHECK(text.substr(start + next) == "\n</AppendedData>\n</VTKFile>\n");
    return arrays;
}

struct CollectionEntry {
    double time;
    int part;
    std::string file;
};

std::vector<CollectionEntry> read_pvd(const std::filesystem::path& file) {
    std::vector<CollectionEntry> entries;
    for (const std::string& tag : tags_of(read_text(file)))
        if (tag.starts_with("DataSet"))
            entries.push_back(
                {std::stod(attribute(tag, "timestep")), std::stoi(attribute(tag, "part")), attribute(tag, "file")});
    return entries;
}

WriterOptions options_in(const TemporaryFolder& folder) {
    WriterOptions options;
    options.folder = folder.path();
    options.stem = "wave";
    options.scene = tank_scene();
    return options;
}

SyntheticFrame small_frame(double time) {
    SyntheticFrame frame(3, 2, time, 7);
    frame.column<std::uint32_t>(Field::id, "<u4", 1, {4, 9})
        .column<float>(Field::position, "<f4", 3, {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f})
        .column<double>(Field::velocity, "<f8", 3, {1.1, 2.2, 3.3, -1, -2, -3})
        .column<float>(Field::density, "<f4", 1, {998.25f, 1001.5f});
    return frame;
}

}  // namespace

TEST_CASE("VtpWriter.ArraysReadBackBitByBit") {
    TemporaryFolder folder;
    auto writer = make_writer("vtp", options_in(folder));
    REQUIRE(writer.ok());
    REQUIRE((*writer)->write(small_frame(0.25).view(), {}).ok());

    auto arrays = read_vtp(folder / "wave_000000.vtp");
    CHECK(arrays["id"].type == "UInt32");
    CHECK(arrays["id"].values<std::uint32_t>() == std::vector<std::uint32_t>{4, 9});
    CHECK(arrays["Points"].type == "Float32");
    CHECK(arrays["Points"].components == 3);
    CHECK(arrays["Points"].values<float>() == std::vector<float>{0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f});
    CHECK(arrays["velocity"].type == "Float64");
    CHECK(arrays["velocity"].values<double>() == std::vector<double>{1.1, 2.2, 3.3, -1, -2, -3});
    CHECK(arrays["density"].values<float>() == std::vector<float>{998.25f, 1001.5f});
    CHECK(arrays["TimeValue"].values<double>() == std::vector<double>{0.25});
    CHECK(arrays["Verts/connectivity"].values<std::int32_t>() == std::vector<std::int32_t>{0, 1});
    CHECK(arrays["Verts/offsets"].values<std::int32_t>() == std::vector<std::int32_t>{1, 2});
    CHECK(arrays["Polys/offsets"].bytes.empty());
    CHECK(arrays.count("position") == 0);
}

// Staubach 2010, Eq. 3.5 with Table 3.1: (3 m / (4 pi rho_0))^(1/3), m = 0.02 kg, rho_0 = 998.29 kg/m^3.
TEST_CASE("VtpWriter.FilesTellTheRadiusToDrawParticlesWith") {
    TemporaryFolder folder;
    WriterOptions options = options_in(folder);
    options.scene.parameters["particle_mass"] = 0.02;
    options.scene.parameters["rest_density"] = 998.29;
    auto writer = make_writer("vtp", options);
    REQUIRE((*writer)->write(small_frame(0).view(), {}).ok());

    auto arrays = read_vtp(folder / "wave_000000.vtp");
    CHECK(arrays["particle_radius"].type == "Float64");
    const auto radius = arrays["particle_radius"].values<double>();
    REQUIRE(radius.size() == 1);
    CHECK(radius[0] == Approx(0.016848512140814474).epsilon(1e-14));  // rounding of a few operations
}

TEST_CASE("VtpWriter.FlatVectorsGetAThirdComponentZero") {
    TemporaryFolder folder;
    auto writer = make_writer("vtp", options_in(folder));
    SyntheticFrame frame(2, 2, 0);
    frame.column<float>(Field::position, "<f4", 2, {1, 2, 3, 4}).column<float>(Field::velocity, "<f4", 2, {5, 6, 7, 8});
    REQUIRE((*writer)->write(frame.view(), {}).ok());

    auto arrays = read_vtp(folder / "wave_000000.vtp");
    CHECK(arrays["Points"].components == 3);
    CHECK(arrays["Points"].values<float>() == std::vector<float>{1, 2, 0, 3, 4, 0});
    CHECK(arrays["velocity"].components == 3);
    CHECK(arrays["velocity"].values<float>() == std::vector<float>{5, 6, 0, 7, 8, 0});
}

TEST_CASE("VtpWriter.CollectionListsExistingFilesAtTheirTimes") {
    TemporaryFolder folder;
    WriterOptions options = options_in(folder);
    options.stem = "a&b";  // must be escaped in XML
    auto writer = make_writer("vtp", options);
    const std::vector<double> times{0, 0.1, 0.30000000000000004};
    for (const double time : times) REQUIRE((*writer)->write(small_frame(time).view(), {}).ok());
    REQUIRE((*writer)->finish().ok());

    const auto entries = read_pvd(folder / "a&b.pvd");
    REQUIRE(entries.size() == times.size());
    for (std::size_t k = 0; k < times.size(); ++k) {
        CHECK(entries[k].time == times[k]);
        CHECK(entries[k].part == 0);
        CHECK(entries[k].file.starts_with("a&amp;b_"));
        CHECK(std::filesystem::exists(folder / ("a&b" + entries[k].file.substr(std::strlen("a&amp;b")))));
    }
    for (const auto& file : std::filesystem::directory_iterator(folder.path()))
        CHECK(file.path().extension() != ".part");
}

TEST_CASE("VtpWriter.ObjectsAreWrittenOnlyWhenTheyChange") {
    TemporaryFolder folder;
    auto writer = make_writer("vtp", options_in(folder));
    const auto with_panel = tank_scene().objects;
    const std::vector without_panel{with_panel[0]};
    for (const auto& objects : {with_panel, with_panel, without_panel, without_panel})
        REQUIRE((*writer)->write(small_frame(0).view(), client::at_rest(objects)).ok());
    REQUIRE((*writer)->finish().ok());

    std::vector<std::string> objects_files;
    for (const auto& entry : read_pvd(folder / "wave.pvd"))
        if (entry.part == 1) objects_files.push_back(entry.file);
    CHECK(objects_files == std::vector<std::string>{"wave_objects_000000.vtp", "wave_objects_000000.vtp",
                                                    "wave_objects_000001.vtp", "wave_objects_000001.vtp"});
    CHECK_FALSE(std::filesystem::exists(folder / "wave_objects_000002.vtp"));

    // Two boxes of six faces, then one.
    CHECK(read_vtp(folder / "wave_objects_000000.vtp")["Polys/offsets"].values<std::int32_t>().size() == 12);
    auto tank = read_vtp(folder / "wave_objects_000001.vtp");
    CHECK(tank["Polys/offsets"].values<std::int32_t>().size() == 6);
    const auto corners = tank["Points"].values<double>();
    CHECK(corners.size() == 8 * 3);
    CHECK(*std::max_element(corners.begin(), corners.end()) == 1.0);
}

TEST_CASE("VtpWriter.AMovingObjectIsWrittenWhereItStandsAtEachTime") {
    TemporaryFolder folder;
    auto writer = make_writer("vtp", options_in(folder));
    const proto::ObjectDesc block{"block", proto::ObjectRole::obstacle, proto::BoxDesc{{0, 0, 0}, {1, 1, 1}}};
    for (const double height : {0.0, 0.25, 0.25}) {
        scene::Placement place;
        place.translation = {0, height, 0};
        REQUIRE((*writer)->write(small_frame(height).view(), {{block, place}}).ok());
    }
    REQUIRE((*writer)->finish().ok());
    const auto lowest = [&](const std::string& file) {
        const auto points = read_vtp(folder / file)["Points"].values<double>();
        double least = points.at(1);
        for (std::size_t k = 1; k < points.size(); k += 3) least = std::min(least, points[k]);
        return least;
    };
    CHECK(lowest("wave_objects_000000.vtp") == 0);
    CHECK(lowest("wave_objects_000001.vtp") == 0.25);
    CHECK_FALSE(std::filesystem::exists(folder / "wave_objects_000002.vtp"));  // it rests again
}

TEST_CASE("VtpWriter.CollectionSurvivesAnAbandonedConversion") {
    TemporaryFolder folder;
    {
        auto writer = make_writer("vtp", options_in(folder));
        REQUIRE((*writer)->write(small_frame(0.5).view(), {}).ok());
    }
    CHECK(read_pvd(folder / "wave.pvd").size() == 1);
}

TEST_CASE("VtpWriter.FramesWithoutPositionsAreRefused") {
    TemporaryFolder folder;
    auto writer = make_writer("vtp", options_in(folder));
    SyntheticFrame frame(3, 1, 0);
    frame.column<float>(Field::density, "<f4", 1, {1});
    const auto written = (*writer)->write(frame.view(), {});
    REQUIRE_FALSE(written.ok());
    CHECK(written.error().code == proto::ErrorCode::invalid_params);
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("Writers.UnknownFormatIsRefusedWithAHint") {
    TemporaryFolder folder;
    const auto writer = make_writer("vpt", options_in(folder));
    REQUIRE_FALSE(writer.ok());
    CHECK(writer.error().code == proto::ErrorCode::invalid_params);
    CHECK(writer.error().hint.find("vtp") != std::string::npos);
    for (const client::FormatInfo& format : client::writer_formats())
        CHECK(make_writer(format.name, options_in(folder)).ok());
}

// What a failed conversion removes is named after it.
TEST_CASE("Writers.FramesHaveTheFileWhoseExtensionIsTold") {
    for (const client::FormatInfo& format : client::writer_formats())
        for (const bool every_frame : {true, false}) {
            TemporaryFolder folder;
            WriterOptions options = options_in(folder);
            options.picture.every_frame = every_frame;
            auto writer = make_writer(format.name, options);
            REQUIRE(writer.ok());
            const SyntheticFrame frame = small_frame(0);
            const std::vector<client::PlacedObject> none;
            REQUIRE((*writer)->prepare({frame.view(), 12, none}).ok());
            std::vector<std::string> files;
            for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
                if (entry.path().stem() == "wave_000012") files.push_back(entry.path().extension());
            const std::string extension((*writer)->frame_extension());
            CHECK(files == (extension.empty() ? std::vector<std::string>{} : std::vector{"." + extension}));
        }
}

TEST_CASE("Writers.UnwritableFolderIsAFileError") {
    TemporaryFolder folder;
    WriterOptions options = options_in(folder);
    std::ofstream(folder / "file") << "in the way";
    options.folder = folder / "file";
    const auto writer = make_writer("vtp", options);
    REQUIRE_FALSE(writer.ok());
    CHECK(writer.error().code == proto::ErrorCode::file_error);
}
