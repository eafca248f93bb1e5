#include <catch2/catch.hpp>

#include "fixtures.h"
#include "server/solver/faults.h"
#include "server/solver/parallel.h"

using namespace headrace::solver;
using namespace headrace::solver::testing;

namespace {

constexpr Domain kDomain{{-1, -1, -1}, {1, 1, 1}};

}  // namespace

TEST_CASE("Faults.SoundStateHasNone") {
    Particles particles = make_particles(3, {{0, 0, 0}, {1, 1, 1}});  // the boundary belongs to the domain
    particles.v[0] = {3.0, 0.0};
    const Inspection found = inspect(particles, kDomain);
    CHECK_FALSE(found.fault);
    CHECK(found.max_speed == 3.0);
}

TEST_CASE("Faults.LowestIdIsReportedWhateverTheThreads") {
    Particles particles = make_particles(3, random_points(6000, 1.0, 3));
    for (std::size_t i = 0; i < particles.size(); ++i) particles.id[i] = static_cast<Index>(particles.size() - 1 - i);
    for (const std::size_t i : {100u, 3000u, 5900u}) particles.x[1][i] = 1.5;
    particles.v[2][4500] = std::nan("");
    const int before = max_threads();
    for (const int threads : {1, 3}) {
        omp_set_num_threads(threads);
        const Inspection found = inspect(particles, kDomain);
        REQUIRE(found.fault);
        CHECK(found.fault->particle == 5999 - 5900);
        CHECK(found.fault->kind == FaultKind::left_domain);
        CHECK(found.fault->x[1] == 1.5);
    }
    omp_set_num_threads(before);
}

TEST_CASE("Faults.EveryFieldIsWatched") {
    for (int field = 0; field < 3; ++field) {
        for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
            Particles particles = make_particles(2, {{0, 0, 0}, {0.1, 0.1, 0}});
            VectorField* fields[] = {&particles.x, &particles.v_half, &particles.v};
            (*fields[field])[1][1] = bad;
            const Inspection found = inspect(particles, kDomain);
            REQUIRE(found.fault);
            CHECK(found.fault->kind == FaultKind::non_finite);
            CHECK(found.fault->particle == 1);
        }
    }
}

TEST_CASE("Faults.FlatSceneIgnoresTheDomainsThirdAxis") {
    CHECK_FALSE(inspect(make_particles(2, {{0, 0, 0}}), Domain{{-1, -1, 5}, {1, 1, 5}}).fault);
}
