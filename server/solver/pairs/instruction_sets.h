// The instruction sets that the pair loops of this program are compiled for: "AVX-512", "AVX2", "SSE4", ..., "SCALAR".
#pragma once

#include <string>
#include <vector>

namespace headrace::solver {

// Those that this machine has, best first.
std::vector<std::string> instruction_sets();

// The one in use.
std::string instruction_set();

// While it lives, loops made anew use this set: for comparisons and tests.
class OnlyInstructionSet {
  public:
    // Precondition: one of instruction_sets().
    explicit OnlyInstructionSet(const std::string& name);
    ~OnlyInstructionSet();
    OnlyInstructionSet(const OnlyInstructionSet&) = delete;
    OnlyInstructionSet& operator=(const OnlyInstructionSet&) = delete;
};

}  // namespace headrace::solver
