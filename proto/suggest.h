// Hints for names that do not exist.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace headrace::proto {

// `did you mean "panel"?` when one of `known` is near enough to be a slip (edit distance with transpositions at most a
// third of the length, at least 1), else `known: a, b, c` (the first dozen), else empty when nothing is known.
std::string suggest(std::string_view name, const std::vector<std::string>& known);

}  // namespace headrace::proto
