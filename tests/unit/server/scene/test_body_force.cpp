#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "server/scene/body_force.h"

using namespace headrace;
using proto::Scalar;

namespace {

solver::Particles row_of_particles(std::size_t count) {
    solver::Particles particles;
    particles.dimensions = 3;
    particles.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        particles.x[0][i] = 0.01 * static_cast<double>(i);
        particles.x[1][i] = 1.0;
        particles.x[2][i] = -0.5 * static_cast<double>(i);
    }
    return particles;
}

solver::VectorField accelerations(const proto::SceneDesc& scene, double t, const solver::Particles& particles) {
    const auto force = scene::make_body_force(scene);
    if (!force) FAIL(force.error().path << ": " << force.error().message);
    REQUIRE(*force);
    solver::VectorField a;
    for (auto& axis : a) axis.assign(particles.size(), 100.0);  // it adds
    (**force)(t, particles, a);
    return a;
}

proto::SceneDesc scene_3d() {
    proto::SceneDesc scene;
    scene.spacing = 0.01;
    return scene;
}

}  // namespace

TEST_CASE("BodyForce.NothingWhereTheSceneHasNone") {
    proto::SceneDesc scene = scene_3d();
    CHECK_FALSE(*scene::make_body_force(scene));
    scene.body_force = {std::string("0*pi"), 0.0, 0.0};
    CHECK_FALSE(*scene::make_body_force(scene));
}

TEST_CASE("BodyForce.AddsWhatItsExpressionsSay") {
    proto::SceneDesc scene = scene_3d();
    scene.body_force = {std::string("sin(x)*t"), 2.5, std::string("x + y + z")};
    const solver::Particles particles = row_of_particles(3000);
    const solver::VectorField a = accelerations(scene, 0.5, particles);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double x = particles.x[0][i], z = particles.x[2][i];
        if (std::abs(a[0][i] - (100 + 0.5 * std::sin(x))) > 1e-12) FAIL("x of particle " << i);
        if (a[1][i] != 102.5) FAIL("y of particle " << i);
        if (std::abs(a[2][i] - (101 + x + z)) > 1e-9) FAIL("z of particle " << i);
    }
}

TEST_CASE("BodyForce.AnAcceleratedFrameContributesMinusItself") {
    proto::SceneDesc scene = scene_3d();
    scene.frame_acceleration = proto::TableDesc{{{0, 0, 0, 0}, {1, 4, 0, -2}}};
    scene.body_force[0] = 1.0;
    const solver::Particles particles = row_of_particles(2);
    const solver::VectorField a = accelerations(scene, 0.5, particles);
    CHECK(a[0][1] == Approx(100 + 1 - 2));
    CHECK(a[1][1] == 100.0);
    CHECK(a[2][1] == Approx(100 + 1));
    scene.frame_acceleration = proto::ScalarVec3{std::string("3*t"), 0.0, 0.0};
    CHECK(accelerations(scene, 2.0, particles)[0][0] == Approx(100 + 1 - 6));
}

TEST_CASE("BodyForce.IsTheSameForAnyNumberOfThreads") {
    proto::SceneDesc scene = scene_3d();
    scene.body_force = {std::string("sin(17*x)*exp(-z) + t"), std::string("x*z/(1 + x)"), 0.0};
    const solver::Particles particles = row_of_particles(10'000);
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    const solver::VectorField one = accelerations(scene, 0.3, particles);
    omp_set_num_threads(5);
    const solver::VectorField five = accelerations(scene, 0.3, particles);
    omp_set_num_threads(before);
    CHECK(one == five);
}

TEST_CASE("BodyForce.RefusalsNameTheMember") {
    proto::SceneDesc scene = scene_3d();
    scene.body_force[1] = Scalar(std::string("sin("));
    CHECK(scene::make_body_force(scene).error().path == "scene.body_force[1]");
    scene.body_force[1] = 0.0;
    scene.frame_acceleration = proto::ScalarVec3{std::string("x"), 0.0, 0.0};  // the same everywhere: t only
    CHECK(scene::make_body_force(scene).error().path == "scene.frame_acceleration[0]");
    scene.frame_acceleration = proto::TableDesc{{{0, 0}, {1, 0}}};
    CHECK(scene::make_body_force(scene).error().path == "scene.frame_acceleration.table[0]");
    scene.frame_acceleration = proto::ScalarVec3{0.0, std::string("1/t"), 0.0};
    CHECK(scene::make_body_force(scene).error().path == "scene.frame_acceleration[1]");
}

TEST_CASE("BodyForce.MustBeFiniteWhereTheFluidIs") {
    proto::SceneDesc scene = scene_3d();
    scene.body_force[2] = Scalar(std::string("1/x"));
    const auto force = scene::make_body_force(scene);
    const auto status = scene::check_body_force(scene, **force, row_of_particles(3));
    REQUIRE_FALSE(status.ok());
    CHECK(status.error().path == "scene.body_force[2]");
    CHECK(status.error().message.find("(0, 1, 0) m") != std::string::npos);
}
