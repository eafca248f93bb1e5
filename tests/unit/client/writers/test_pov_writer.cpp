// Scenes for POV-Ray, as text; tests/cli/films.sh lets povray render them.
#include <catch2/catch.hpp>
#include <regex>

#include "client/writers/stage.h"
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

// What a scene says of its camera.
struct SeenBy {
    bool is_perspective;
    Vec3 location, right, up, direction;

    explicit SeenBy(const std::string& text) : is_perspective(text.find("perspective") != std::string::npos) {
        for (const auto& [name, into] : {std::pair{"location", &location}, std::pair{"right", &right},
                                         std::pair{"up", &up}, std::pair{"direction", &direction}}) {
            std::smatch found;
            REQUIRE(std::regex_search(text, found, std::regex(std::string(name) + " <([^,]*),([^,]*),([^>]*)>")));
            for (std::size_t k = 0; k < 3; ++k) (*into)[k] = std::stod(found[k + 1]);
        }
    }

    // Where it sees a point, from the middle, in widths to the right and heights upwards: POV-Ray's rays start at
    // location (orthographic: + x right + y up) and go along direction (perspective: + x right + y up).
    std::pair<double, double> place(const Vec3& point) const {
        const Vec3 offset = point - location;
        const double volume = dot(direction, cross(right, up));
        const double far = is_perspective ? dot(offset, cross(right, up)) / volume : 1;
        return {dot(offset, cross(up, direction)) / volume / far, dot(offset, cross(direction, right)) / volume / far};
    }
};

// Views of all kinds.
std::vector<ViewOptions> views() {
    std::vector<ViewOptions> all(4);
    all[1].name = ViewName::front;
    all[2].name = ViewName::iso;
    all[3].position = Vec3{2.5, 1.5, 2};
    return all;
}

constexpr double kRounding = 1e-4;  // of six digits a number, over a few of them

}  // namespace

TEST_CASE("PovWriter.SeesWhatThePicturesSee") {
    for (const int dimensions : {2, 3})
        for (ViewOptions view : views())
            for (const double zoom : {1.0, 3.0, 0.5})
                for (const bool has_target : {false, true}) {
                    proto::SceneDesc scene = tank_scene();
                    scene.dimensions = dimensions;
                    view.zoom = zoom;
                    if (has_target) view.target = Vec3{0.25, 0.1, 0.3};
                    const SeenBy seen(written(scene, {}, view));
                    const Camera camera = make_camera(scene, make_stage(scene, view), view, {0, 0, 1280, 720});
                    for (const Vec3& x : {Vec3{0, 0, 0}, Vec3{1, 0.8, 0.4}, Vec3{0.3, 0.7, 0.1}}) {
                        const Projected pixel = camera.project(x);
                        const auto [right, up] = seen.place(x);
                        // A margin of 6 % about the picture.
                        CHECK(1.06 * right == Approx((pixel.x - 640) / 1280).margin(kRounding));
                        CHECK(1.06 * up == Approx((360 - pixel.y) / 720).margin(kRounding));
                    }
                }
}

TEST_CASE("PovWriter.AZoomMovesTheTargetToTheMiddle") {
    const Vec3 target{0.25, 0.1, 0.3};
    for (ViewOptions view : views()) {
        const auto width = [&](const SeenBy& seen) {
            return seen.place(target + 0.05 * normalized(seen.right)).first - seen.place(target).first;
        };
        view.target = target;
        const SeenBy whole(written(tank_scene(), {}, view));
        view.zoom = 3;
        const SeenBy near(written(tank_scene(), {}, view));
        CHECK(near.place(target).first == Approx(0).margin(kRounding));
        CHECK(near.place(target).second == Approx(0).margin(kRounding));
        CHECK(width(near) == Approx(3 * width(whole)).epsilon(0.001));
    }
}

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
