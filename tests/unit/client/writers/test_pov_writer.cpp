// Scenes for POV-Ray, as text; tests/cli/films.sh lets povray render them.
#include <catch2/catch.hpp>
#include <regex>

#include "client/writers/writer.h"
#include "tests/unit/client/writers/synthetic.h"

using namespace headrace;
using namespace headrace::client;
using namespace headrace::tests;
using proto::Field;

namespace {

SyntheticFrame two_particles(int dimensions) {
    SyntheticFrame frame(dimensions, 2, 0);
    if (dimensions == 3)
        frame.column<float>(Field::position, "<f4", 3, {0.1f, 0.1f, 0.1f, 0.5f, 0.6f, 0.2f})
            .column<float>(Field::velocity, "<f4", 3, {0, 0, 0, 1, 1, 1});
    else
        frame.column<float>(Field::position, "<f4", 2, {0.1f, 0.1f, 0.5f, 0.6f})
            .column<float>(Field::velocity, "<f4", 2, {0, 0, 1, 1});
    return frame;
}

std::string written(const proto::SceneDesc& scene, const std::vector<PlacedObject>& objects,
                    const ViewOptions& view = {}) {
    TemporaryFolder folder;
    WriterOptions options;
    options.folder = folder.path();
    options.stem = "wave";
    options.scene = scene;
    options.picture.view = view;
    auto writer = make_writer("pov", options);
    if (!writer) FAIL(writer.error().message);
    REQUIRE((*writer)->write(two_particles(scene.dimensions).view(), objects).ok());
    return read_text(folder / "wave_000000.pov");
}

int count_of(const std::string& text, const std::string& what) {
    const std::regex pattern(what);
    return static_cast<int>(std::distance(std::sregex_iterator(text.begin(), text.end(), pattern), {}));
}

// What follows the comment with the object's name, to its line's end.
std::string line_after(const std::string& text, const std::string& name) {
    const std::size_t start = text.find("// " + name + "\n") + name.size() + 4;
    return text.substr(start, text.find('\n', start) - start);
}

}  // namespace

TEST_CASE("PovWriter.ParticlesAreSpheresAndTanksPanesWithEdges") {
    const std::string text = written(tank_scene(), at_rest({tank_scene().objects[0]}));
    CHECK(count_of(text, "sphere\\{<") == 2);
    CHECK(count_of(text, "polygon \\{ 5,") == 6);
    CHECK(count_of(text, "cylinder \\{") == 12);
    CHECK(count_of(text, "light_source") >= 2);
}

TEST_CASE("PovWriter.FlatTanksAreOutlinesThatHideNothing") {
    proto::SceneDesc scene = tank_scene();
    scene.dimensions = 2;
    const std::string text = written(scene, at_rest({scene.objects[0]}));
    CHECK(count_of(text, "polygon") == 0);
    CHECK(count_of(text, "cylinder \\{") == 4);
}

TEST_CASE("PovWriter.PlanesAreSheetsAsLargeAsTheScene") {
    const proto::ObjectDesc floor{"floor", proto::ObjectRole::obstacle, proto::PlaneDesc{{0, 0, 0}, {0, 1, 0}}};
    const std::string text = written(tank_scene(), {floor});
    CHECK(line_after(text, "floor").starts_with("polygon { 5, <"));
    CHECK(count_of(text, "plane \\{") == 0);
}

TEST_CASE("PovWriter.ObjectsStandWhereTheirPlacementSays") {
    proto::SceneDesc scene = tank_scene();
    scene::Placement raised;
    raised.translation = {0, 0.25, 0};
    const proto::ObjectDesc ball{"ball", proto::ObjectRole::obstacle, proto::SphereDesc{{0.5, 0.25, 0.2}, 0.1}};
    CHECK(line_after(written(scene, {ball}), "ball").starts_with("sphere { <0.5,0.25,0.2>"));
    CHECK(line_after(written(scene, {PlacedObject(ball, raised)}), "ball").starts_with("sphere { <0.5,0.5,0.2>"));

    // A quarter turn about z takes the box's first edge upwards.
    const proto::ObjectDesc box{"box", proto::ObjectRole::obstacle, proto::BoxDesc{{0, 0, 0}, {0.4, 0.2, 0.1}}};
    const scene::Placement turned{{}, {}, scene::rotation(M_PI / 2, {0, 0, 1})};
    std::smatch edge;
    const std::string line = line_after(written(scene, {PlacedObject(box, turned)}), "box");
    REQUIRE(std::regex_search(line, edge, std::regex("matrix <([^,]*),([^,]*),([^,]*),")));
    CHECK(std::stod(edge[1]) == Approx(0).margin(1e-12));
    CHECK(std::stod(edge[2]) == Approx(0.4).epsilon(0.01));  // drawn a little smaller
}

TEST_CASE("PovWriter.ACropLeavesOutWhatIsBesideIt") {
    ViewOptions view;
    view.crop = proto::BoxDesc{{0, 0, 0}, {0.3, 0.3, 0.4}};
    CHECK(count_of(written(tank_scene(), {}, view), "sphere\\{<") == 1);
}
