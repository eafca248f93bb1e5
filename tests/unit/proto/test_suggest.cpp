#include <catch2/catch.hpp>

#include "proto/suggest.h"

using headrace::proto::suggest;

TEST_CASE("Suggest.FindsSlips") {
    const std::vector<std::string> known{"panel", "tank", "ball"};
    CHECK(suggest("pannel", known) == "did you mean \"panel\"?");
    CHECK(suggest("pnael", known) == "did you mean \"panel\"?");  // one swap is one slip: 5 / 3 = 1
    CHECK(suggest("tan", known) == "did you mean \"tank\"?");
    CHECK(suggest("panel", known) == "did you mean \"panel\"?");
}

TEST_CASE("Suggest.TakesTheNearest") {
    CHECK(suggest("viscosty", {"density", "viscosity", "velocity"}) == "did you mean \"viscosity\"?");
}

TEST_CASE("Suggest.ListsWhatIsKnownWhenNothingIsNear") {
    CHECK(suggest("xyz", {"panel", "tank"}) == "known: panel, tank");
    CHECK(suggest("pxxel", {"panel"}) == "known: panel");  // two slips in five letters are too many
    CHECK(suggest("xyz", {}).empty());
}

TEST_CASE("Suggest.ListsADozenAtMost") {
    const std::vector<std::string> twelve{"a1", "a2", "a3", "a4", "a5", "a6", "a7", "a8", "a9", "b1", "b2", "b3"};
    CHECK(suggest("zzz", twelve) == "known: a1, a2, a3, a4, a5, a6, a7, a8, a9, b1, b2, b3");
    std::vector<std::string> thirteen = twelve;
    thirteen.push_back("b4");
    CHECK(suggest("zzz", thirteen) == "known: a1, a2, a3, a4, a5, a6, a7, a8, a9, b1, b2, b3, ...");
}

TEST_CASE("Suggest.DoesNotCompareHugeNames") {
    CHECK(suggest(std::string(10'000'000, 'p'), {"panel"}) == "known: panel");
}
