// Camera, raster, palette, colour bar and objects: truths about single pixels.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <tuple>

#include "client/writers/annotations.h"
#include "client/writers/palette.h"
#include "client/writers/scene_renderer.h"
#include "tests/unit/client/writers/synthetic.h"

using namespace headrace;
using namespace headrace::client;
using namespace headrace::tests;

namespace {

constexpr Viewport kWindow{20, 10, 200, 100};  // [px]
const Vec3 kUp{0, 1, 0};

std::vector<Vec3> corners(const proto::BoxDesc& box) {
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k) points.push_back(box_corner(box, k));
    return points;
}

// Looks along -z at 2 m x 1 m: 100 px per metre.
Camera front_camera() {
    return Camera::orthographic(corners({{0, 0, 0}, {2, 1, 0}}), kUp, kWindow);
}

Image resolved(const Raster& raster, int width, int height) {
    Image image(width, height, {});
    raster.resolve(image);
    return image;
}

int difference(Rgb a, Rgb b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
}

constexpr Rgb kWhite{255, 255, 255}, kRed{255, 0, 0}, kBlue{0, 0, 255};

}  // namespace

TEST_CASE("Camera.OrthographicPointLandsWhereComputed") {
    const Projected point = front_camera().project({0.5, 0.25, 0});
    CHECK(point.x == Approx(20 + 0.5 * 100));
    CHECK(point.y == Approx(10 + (1 - 0.25) * 100));
}

TEST_CASE("Camera.PerspectiveFillsTheViewportAndNothingElse") {
    const auto points = corners({{0, 0, 0}, {1, 0.8, 0.4}});
    const Camera camera = Camera::perspective(points, kUp, kWindow);
    const Viewport seen = camera.covered(points);
    CHECK(seen.left >= kWindow.left - 1e-9);
    CHECK(seen.left + seen.width <= kWindow.left + kWindow.width + 1e-9);
    // The tank is less wide than the viewport, so the height decides.
    CHECK(seen.top == Approx(kWindow.top));
    CHECK(seen.height == Approx(kWindow.height));
    // Up is up, right is right, and the front is nearer than the back.
    const Projected origin = camera.project({0, 0, 0});
    CHECK(camera.project({0, 0.1, 0}).y < origin.y);
    CHECK(camera.project({0.1, 0, 0}).x > origin.x);
    CHECK(camera.project({0, 0, 0.1}).nearness > origin.nearness);
}

TEST_CASE("Camera.UpMayBeAnyAxis") {
    const auto points = corners({{-1, -1, -1}, {1, 1, 1}});
    for (const Vec3 up : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
        const Camera camera = Camera::perspective(points, up, kWindow);
        CHECK(camera.project(0.5 * up).y < camera.project({0, 0, 0}).y);
        CHECK(length(cross(camera.right(), camera.up()) - camera.backward()) == Approx(0).margin(1e-12));
    }
}

TEST_CASE("Camera.RayOfAPixelProjectsOntoIt") {
    const auto points = corners({{0, 0, 0}, {1, 0.8, 0.4}});
    for (const Camera& camera : {Camera::perspective(points, kUp, kWindow), front_camera()}) {
        const Camera::Ray ray = camera.ray(37.5, 61.25);
        for (const double depth : {0.5, 3.0}) {
            const Projected seen = camera.project(ray.origin + depth * ray.direction);
            CHECK(seen.x == Approx(37.5));
            CHECK(seen.y == Approx(61.25));
            CHECK(seen.nearness == Approx(camera.nearness_at_depth(depth)));
        }
    }
}

TEST_CASE("Raster.NearerParticleHidesFarther") {
    const auto points = corners({{-1, -1, -1}, {1, 1, 1}});
    const Camera camera = Camera::perspective(points, kUp, {0, 0, 100, 100});
    // Both on the line of sight of one pixel.
    const Camera::Ray ray = camera.ray(50.5, 50.5);
    const Vec3 far = ray.origin + 8.0 * ray.direction, near = ray.origin + 7.0 * ray.direction;
    for (const bool near_first : {true, false}) {
        Raster raster(100, 100, camera);
        raster.clear(kWhite);
        if (near_first) raster.particle(near, 0.3, kBlue);
        raster.particle(far, 0.3, kRed);
        if (!near_first) raster.particle(near, 0.3, kBlue);
        const Rgb seen = resolved(raster, 100, 100).at(50, 50);
        CHECK(seen.b > 200);
        CHECK(seen.r < 120);  // the highlight adds some white
    }
}

TEST_CASE("Raster.ParticleIsADiscOfItsRadius") {
    Raster raster(240, 120, front_camera());
    raster.clear(kWhite);
    raster.particle({1, 0.5, 0}, 0.2, kRed);  // centre at (120, 60), radius 20 px
    const Image image = resolved(raster, 240, 120);
    double area = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 240; ++x)
            if (image.at(x, y) != kWhite) {
                ++area;
                // Half a pixel's diagonal beyond the radius at most.
                CHECK(std::hypot(x + 0.5 - 120, y + 0.5 - 60) < 20 + 0.75);
            }
    // Pixels cut by the rim count wholly: half of the circumference too many, 5 % of the area.
    CHECK(area == Approx(std::numbers::pi * 20 * 20).epsilon(0.08));
    CHECK(image.at(120, 60).r > 200);
}

TEST_CASE("Raster.TranslucentPolygonBlendsAndIsHiddenByNearerParticles") {
    Raster raster(240, 120, front_camera());
    raster.clear(kWhite);
    raster.particle({1, 0.5, 0.5}, 0.2, kRed);
    const std::vector<Vec3> sheet{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    const Rgb before = resolved(raster, 240, 120).at(120, 60);
    raster.polygon(sheet, kBlue, 0.5);
    const Image image = resolved(raster, 240, 120);
    CHECK(image.at(120, 60) == before);
    // Half of white, half of blue; 1 of 255 for rounding in each channel.
    CHECK(difference(image.at(30, 20), {128, 128, 255}) <= 3);
    CHECK(image.at(10, 60) == kWhite);
}

TEST_CASE("Raster.NothingIsDrawnOutsideOrForBadNumbers") {
    Raster raster(240, 120, front_camera());
    raster.clear(kWhite);
    raster.particle({std::nan(""), 0, 0}, 0.1, kRed);
    raster.particle({0, INFINITY, 0}, 0.1, kRed);
    raster.particle({1e9, 0, 0}, 0.1, kRed);
    raster.line({-5, -5, 0}, {-5, 5, 0}, 2, kRed, 1);
    const Image image = resolved(raster, 240, 120);
    CHECK(std::count(image.pixels.begin(), image.pixels.end(), Image::packed(kWhite)) == 240 * 120);
}

TEST_CASE("Palette.EndsAreViridisAndLightnessAscends") {
    CHECK(palette_color(0) == Rgb{0x44, 0x01, 0x54});
    CHECK(palette_color(1) == Rgb{0xFD, 0xE7, 0x25});
    CHECK(palette_color(-3) == palette_color(0));
    CHECK(palette_color(7) == palette_color(1));
    CHECK(palette_color(std::nan("")) == kNotANumber);
    double last = -1;
    for (int k = 0; k <= 100; ++k) {
        const Rgb c = palette_color(k / 100.0);
        const double luma = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
        // Half a step of rounding in the largest channel.
        CHECK(luma > last - 0.5);
        last = luma;
    }
}

TEST_CASE("ColorBar.EndsAreThePalettesEnds") {
    Image image(400, 720, kWhite);
    const BarBox box = bar_box(720, 390, 1);
    draw_color_bar(image, box, {proto::Field::pressure, 0, 5000}, 1);
    const int middle = box.left + box.width / 2;
    CHECK(image.at(middle, box.top) == palette_color(1));
    CHECK(image.at(middle, box.top + box.height - 1) == palette_color(0));
    CHECK(difference(image.at(middle, box.top + box.height / 2), palette_color(0.5)) <= 3);
    CHECK(image.at(10, 10) == kWhite);
}

TEST_CASE("ColorBar.TicksAreRoundAndWithinTheScale") {
    CHECK(tick_values(0, 3.5, 6) == std::vector<double>{0, 1, 2, 3});
    CHECK(tick_values(900, 1500, 6) == std::vector<double>{900, 1000, 1100, 1200, 1300, 1400, 1500});
    const auto ticks = tick_values(-1e-4, 1e-4, 5);
    CHECK(ticks.size() >= 3);
    for (const double tick : ticks) CHECK(std::abs(tick) <= 1.0001e-4);
}

TEST_CASE("SceneRenderer.ARemovedPanelChangesNothingElse") {
    const proto::SceneDesc scene = tank_scene();
    SceneRenderer renderer(scene, make_stage(scene), {}, 320, 240, {10, 10, 300, 220});
    const std::vector<Vec3> particles{{0.1, 0.1, 0.1}, {0.8, 0.05, 0.3}};
    const std::vector<float> values{0.2f, 0.9f};
    const Image with = renderer.draw(particles, values, at_rest(scene.objects));
    const Image without = renderer.draw(particles, values, at_rest({scene.objects[0]}));

    // The panel is drawn where it is inside the tank; its edges are 1.3 px wide.
    const Block panel = visible_block(scene.objects[1], at_rest(scene.objects));
    CHECK(panel.corners[7][1] == 0.8);
    const Viewport region = renderer.camera().covered(panel.corners);
    int changed = 0;
    for (int y = 0; y < with.height; ++y)
        for (int x = 0; x < with.width; ++x) {
            if (with.at(x, y) == without.at(x, y)) continue;
            ++changed;
            CHECK(x + 1 > region.left - 1.5);
            CHECK(x < region.left + region.width + 1.5);
            CHECK(y + 1 > region.top - 1.5);
            CHECK(y < region.top + region.height + 1.5);
        }
    CHECK(changed > 100);
}

// A round log seen from the side covers its rectangle.
TEST_CASE("SceneRenderer.CylindersAreDrawn") {
    const proto::SceneDesc scene = tank_scene();
    SceneRenderer renderer(scene, make_stage(scene), {}, 320, 240, {10, 10, 300, 220});
    const proto::ObjectDesc log{"log", proto::ObjectRole::obstacle,
                                proto::CylinderDesc{{0.2, 0.4, 0.2}, {0.8, 0.4, 0.2}, 0.1}};
    const Image nothing = renderer.draw({}, {}, {}), with_log = renderer.draw({}, {}, {log});
    const Projected middle = renderer.camera().project({0.5, 0.4, 0.2});
    const int x = static_cast<int>(middle.x), y = static_cast<int>(middle.y);
    CHECK(difference(with_log.at(x, y), nothing.at(x, y)) > 30);
    const Projected above = renderer.camera().project({0.5, 0.65, 0.2});
    CHECK(with_log.at(static_cast<int>(above.x), static_cast<int>(above.y)) == nothing.at(x, y));
}

// Each object moved by its placement, seen at a point that it covers only there; nothing is left where it was.
TEST_CASE("SceneRenderer.ObjectsAreDrawnWhereTheyStand") {
    for (const int dimensions : {2, 3}) {
        proto::SceneDesc scene = tank_scene();
        scene.dimensions = dimensions;
        SceneRenderer renderer(scene, make_stage(scene), {}, 320, 240, {10, 10, 300, 220});
        const double z = dimensions == 2 ? 0 : 0.2;
        const auto seen_at = [&](const Image& image, const Vec3& x) {
            const Projected p = renderer.camera().project(x);
            return image.at(static_cast<int>(p.x), static_cast<int>(p.y));
        };
        scene::Placement moved;
        moved.translation = {0.5, 0.3, 0};
        // Up the panel's middle it is a quarter turn about its foot that lays it down.
        scene::Placement laid{{0.2, 0.2, z}, {}, scene::rotation(-std::numbers::pi / 2, {0, 0, 1})};
        const Vec3 before{0.2, 0.4, z};
        const proto::BoxDesc panel{{0.17, 0.2, z - 0.03}, {0.23, 0.6, z + 0.03}};
        const Image nothing = renderer.draw({}, {}, {});
        for (const auto& [shape, place, after] : std::vector<std::tuple<proto::ShapeDesc, scene::Placement, Vec3>>{
                 {panel, moved, {0.7, 0.7, z}},
                 {panel, laid, {0.4, 0.2, z}},
                 {proto::SphereDesc{before, 0.06}, moved, {0.7, 0.7, z}},
                 {proto::SphereDesc{before, 0.06}, laid, {0.4, 0.2, z}}}) {
            const PlacedObject object({"body", proto::ObjectRole::obstacle, shape}, place);
            const Image image = renderer.draw({}, {}, {object});
            CHECK(difference(seen_at(image, after), seen_at(nothing, after)) > 30);
            CHECK(seen_at(image, before) == seen_at(nothing, before));
        }
    }
}

// A floor is a sheet as large as the scene, a little larger than the fluid's box and no more.
TEST_CASE("SceneRenderer.PlanesAreDrawnAsFarAsTheSceneGoes") {
    proto::SceneDesc scene = tank_scene();
    scene.objects.clear();
    SceneRenderer renderer(scene, make_stage(scene), {}, 320, 240, {60, 60, 200, 120});
    const proto::ObjectDesc floor{"floor", proto::ObjectRole::obstacle, proto::PlaneDesc{{0, 0, 0}, {0, 2, 0}}};
    const Image nothing = renderer.draw({}, {}, {}), with_floor = renderer.draw({}, {}, {floor});
    const Projected inside = renderer.camera().project({0.15, 0, 0.2});
    CHECK(difference(with_floor.at(static_cast<int>(inside.x), static_cast<int>(inside.y)), kPaper) > 30);
    for (const int y : {2, 238})
        for (int x = 0; x < 320; ++x) CHECK(with_floor.at(x, y) == nothing.at(x, y));
}

TEST_CASE("PlaneInBox.IsAConvexPolygonOnThePlane") {
    const proto::PlaneDesc oblique{{0.5, 0.5, 0.5}, {1, 2, 3}};
    const auto cut = plane_in_box(oblique, {{0, 0, 0}, {1, 1, 1}});
    REQUIRE(cut.size() >= 3);
    const Vec3 normal = normalized(oblique.normal);
    for (std::size_t k = 0; k < cut.size(); ++k) {
        CHECK(dot(cut[k] - oblique.point, normal) == Approx(0).margin(1e-12));
        const Vec3 a = cut[(k + 1) % cut.size()] - cut[k], b = cut[(k + 2) % cut.size()] - cut[(k + 1) % cut.size()];
        CHECK(dot(cross(a, b), normal) > 0);  // always the same way round
    }
    CHECK(plane_in_box({{0, 5, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 1, 1}}).empty());
    CHECK(plane_in_box({{0, 0.5, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}}).size() == 2);  // 2D: a line's ends
}

TEST_CASE("SceneRenderer.ParticleShowsTheColourOfItsValue") {
    proto::SceneDesc scene = tank_scene();
    scene.spacing = 0.1;  // large spheres
    SceneRenderer renderer(scene, make_stage(scene), {proto::Field::pressure, 0, 10}, 320, 240, {10, 10, 300, 220});
    const Vec3 place{0.5, 0.4, 0.4};
    const Projected seen = renderer.camera().project(place);
    const auto color_of = [&](float value) {
        const std::vector<Vec3> one{place};
        const std::vector<float> values{value};
        return renderer.draw(one, values, {}).at(static_cast<int>(seen.x), static_cast<int>(seen.y));
    };
    // Yellow above, violet below, off the palette where the value is no number.
    CHECK(color_of(10).g > 2 * color_of(10).b);
    CHECK(color_of(0).b > color_of(0).g);
    CHECK(color_of(99) == color_of(10));
    CHECK(difference(color_of(NAN), color_of(0)) > 60);
}

TEST_CASE("SceneView.RadiusHoldsTheParticlesMass") {
    proto::SceneDesc scene = tank_scene();
    // Staubach 2010, Eq. 3.5 with m = rho0 spacing^3: (3 / (4 pi))^(1/3) = 0.6204 spacings.
    CHECK(particle_radius(scene) == Approx(0.62035 * scene.spacing).epsilon(1e-4));
    scene.parameters["particle_mass"] = 8 * 1000.0 * std::pow(scene.spacing, 3);
    CHECK(particle_radius(scene) == Approx(2 * 0.62035 * scene.spacing).epsilon(1e-4));
}

TEST_CASE("SceneView.GuessedScalesCoverWhatTheSceneCanDo") {
    const proto::SceneDesc scene = tank_scene();
    PictureOptions options;
    const double free_fall = std::sqrt(2 * 9.82 * 0.5), hydrostatic = 1000 * 9.82 * 0.5;
    const ColorScale speed = make_color_scale(scene, options);
    CHECK(speed.min == 0);
    // Rounded up to a number that reads well, by a third at most.
    CHECK(speed.max >= free_fall);
    CHECK(speed.max <= 1.34 * free_fall);
    options.color_field = proto::Field::pressure;
    CHECK(make_color_scale(scene, options).max >= hydrostatic);
    CHECK(make_color_scale(scene, options).max <= 1.34 * hydrostatic);

    options.color_min = -100;
    options.color_max = 250;
    CHECK(make_color_scale(scene, options).min == -100);
    CHECK(make_color_scale(scene, options).max == 250);
    options.color_min = 1e6;
    options.color_max.reset();
    CHECK(make_color_scale(scene, options).max > 1e6);
}

TEST_CASE("SceneView.PlanesDoNotReachToTheHorizon") {
    proto::SceneDesc scene = tank_scene();
    const proto::BoxDesc before = visible_bounds(scene);
    scene.objects.push_back({"floor", proto::ObjectRole::obstacle, proto::PlaneDesc{{0, 0, 0}, {0, 1, 0}}});
    CHECK(visible_bounds(scene) == before);
}

TEST_CASE("SceneView.UpIsAgainstGravity") {
    proto::SceneDesc scene = tank_scene();
    CHECK(up_axis(scene) == Vec3{0, 1, 0});
    scene.parameters["gravity"] = Vec3{0, 0.5, -9.81};
    CHECK(up_axis(scene) == Vec3{0, 0, 1});
    scene.parameters.erase("gravity");
    CHECK(up_axis(scene) == Vec3{0, 1, 0});
}
