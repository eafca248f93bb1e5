#include <catch2/catch.hpp>
#include <random>

#include "server/solver/boundaries/box.h"

using namespace headrace::solver;

namespace {

const BoxBoundary<3> kBox{{1.0, 2.0, 3.0}, {0.5, 1.0, 1.5}};  // [0.5, 1.5] x [1, 3] x [1.5, 4.5]
const BoxBoundary<2> kPanel{{0.305, 0.5}, {0.005, 0.5}};      // [0.30, 0.31] x [0, 1]

}  // namespace

TEST_CASE("BoxContainer.FIsTheLargestExcess") {
    CHECK(kBox.F({1.0, 2.0, 3.0}) == Approx(-0.5));
    CHECK(kBox.F({1.75, 2.0, 3.0}) == Approx(0.25));
    CHECK(kBox.F({1.75, 0.5, 3.0}) == Approx(0.5));
    CHECK(kBox.F({1.5, 2.0, 3.0}) == 0.0);
    CHECK(kPanel.F({0.2, 0.5}) == Approx(0.1));
}

TEST_CASE("BoxContainer.FaceContact") {
    const Contact<3> contact = kBox.container_contact({1.75, 2.5, 3.0});
    CHECK(contact.cp == Point<3>{1.5, 2.5, 3.0});
    CHECK(contact.n == Point<3>{-1.0, 0.0, 0.0});
    CHECK(contact.d == Approx(0.25));
}

TEST_CASE("BoxContainer.CornerNormalIsTheUnitVectorToTheCorner") {
    const Contact<3> contact = kBox.container_contact({1.5 + 0.2, 3.0 + 0.1, 1.5 - 0.2});
    CHECK(contact.cp == Point<3>{1.5, 3.0, 1.5});
    CHECK(contact.d == Approx(0.3));
    CHECK(contact.n[0] == Approx(-2.0 / 3.0));
    CHECK(contact.n[1] == Approx(-1.0 / 3.0));
    CHECK(contact.n[2] == Approx(2.0 / 3.0));

    const BoxBoundary<2> flat{{0.0, 0.0}, {1.0, 1.0}};
    const Contact<2> corner = flat.container_contact({-1.3, -1.4});
    CHECK(corner.cp == Point<2>{-1.0, -1.0});
    CHECK(corner.d == Approx(0.5));
    CHECK(corner.n[0] == Approx(0.6));
    CHECK(corner.n[1] == Approx(0.8));
}

TEST_CASE("BoxObstacle.ThinPanelHoldsAtAnySpeed") {
    for (const double speed : {0.001, 1.0, 1000.0}) {
        const auto contact = kPanel.entry_contact({0.2995, 0.5}, {0.2995 + speed, 0.6});
        REQUIRE(contact);
        CHECK(contact->cp == Point<2>{kPanel.low(0), 0.6});
        CHECK(contact->n == Point<2>{-1.0, 0.0});
        CHECK(contact->d == Approx(speed - 0.0005));
    }
    const auto from_the_right = kPanel.entry_contact({0.5, 0.5}, {-0.5, 0.5});
    REQUIRE(from_the_right);
    CHECK(from_the_right->cp[0] == kPanel.high(0));
    CHECK(from_the_right->n == Point<2>{1.0, 0.0});
}

TEST_CASE("BoxObstacle.EntersByTheFaceThePathMeetsFirst") {
    // Ends nearer to the left face, but came in through the top.
    const auto contact = kBox.entry_contact({0.6, 3.1, 3.0}, {0.6, 2.0, 3.0});
    REQUIRE(contact);
    CHECK(contact->cp == Point<3>{0.6, 3.0, 3.0});
    CHECK(contact->n == Point<3>{0.0, 1.0, 0.0});
    const auto below = kBox.entry_contact({1.0, 2.0, 1.0}, {1.0, 2.0, 1.6});
    REQUIRE(below);
    CHECK(below->n == Point<3>{0.0, 0.0, -1.0});
}

TEST_CASE("BoxObstacle.TouchingSlidingAndPassingByAreNoEntry") {
    CHECK_FALSE(kPanel.entry_contact({0.30, 0.2}, {0.30, 0.6}));      // slides along the face
    CHECK_FALSE(kPanel.entry_contact({0.2, 0.2}, {0.30, 0.6}));       // ends on the face
    CHECK_FALSE(kPanel.entry_contact({0.30, 0.2}, {0.25, 0.6}));      // leaves the face
    CHECK_FALSE(kPanel.entry_contact({0.2, 0.9}, {0.4, 1.5}));        // passes above
    CHECK_FALSE(kPanel.entry_contact({0.305, 0.5}, {0.5, 0.5}));      // comes out: did not enter
    CHECK(kPanel.entry_contact({kPanel.low(0), 0.2}, {0.302, 0.2}));  // from the face inward is one
    CHECK(kPanel.is_clear_of({0.1, 0.1}, {0.29, 0.9}));
    CHECK_FALSE(kPanel.is_clear_of({0.1, 0.1}, {0.9, 0.9}));
}

TEST_CASE("BoxObstacle.ParticleFoundInsideGoesToTheNearestFreeFace") {
    const auto anywhere = [](const Point<3>&) { return true; };
    CHECK(kBox.nearest_face_contact({0.6, 2.0, 3.0}, anywhere).n == Point<3>{-1.0, 0.0, 0.0});
    CHECK(kBox.nearest_face_contact({1.0, 2.9, 3.0}, anywhere).n == Point<3>{0.0, 1.0, 0.0});
    CHECK(kBox.nearest_face_contact({1.0, 2.0, 1.6}, anywhere).cp == Point<3>{1.0, 2.0, 1.5});
    const auto above_floor = [](const Point<3>& x) { return x[1] > 1.5; };
    CHECK(kBox.nearest_face_contact({1.1, 1.05, 3.0}, anywhere).n == Point<3>{0.0, -1.0, 0.0});
    CHECK(kBox.nearest_face_contact({1.1, 1.75, 3.0}, above_floor).n == Point<3>{1.0, 0.0, 0.0});
    const auto nowhere = [](const Point<3>&) { return false; };
    CHECK(kBox.nearest_face_contact({0.6, 2.0, 3.0}, nowhere).n == Point<3>{-1.0, 0.0, 0.0});
}

TEST_CASE("BoxObstacle.RandomPathsNeverEndInside") {
    const unsigned seed = 21;
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 5.0);
    int entries = 0;
    for (int i = 0; i < 20000; ++i) {
        const Point<3> x0{uniform(random), uniform(random), uniform(random)};
        Point<3> x1{uniform(random), uniform(random), uniform(random)};
        if (kBox.F(x0) < 0.0) continue;
        if (const auto contact = kBox.entry_contact(x0, x1)) {
            ++entries;
            x1 = contact->cp;
        }
        CHECK(kBox.F(x1) >= 0.0);
    }
    CHECK(entries > 1000);
}
