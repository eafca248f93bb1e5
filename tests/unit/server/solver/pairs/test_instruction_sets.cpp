#include <algorithm>
#include <catch2/catch.hpp>

#include "server/solver/isa.h"
#include "server/solver/pairs/instruction_sets.h"

using namespace headrace;

// Both models tell the set in `strategy`, doctor tells those of the machine: one thing has one name.
TEST_CASE("InstructionSets.HaveOneNameWhoeverTellsThem") {
    const std::vector<std::string> names = solver::instruction_sets();
    REQUIRE_FALSE(names.empty());
    CHECK(solver::instruction_set() == names.front());
    for (const std::string& name : names) CHECK(name.find("AVX3") == std::string::npos);
    if (const solver::Isa best = solver::best_isa(); best != solver::Isa::baseline)
        CHECK(std::count(names.begin(), names.end(), solver::isa_name(best)) == 1);
    for (const std::string& name : names) {
        const solver::OnlyInstructionSet only(name);
        CHECK(solver::instruction_set() == name);
    }
    CHECK(solver::instruction_set() == names.front());
}
