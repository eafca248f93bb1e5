#include "proto/suggest.h"

#include <algorithm>
#include <cstddef>

namespace headrace::proto {

namespace {

constexpr std::size_t kListed = 12;
constexpr std::size_t kLongestName = 64;  // longer ones are no slip, and would cost time

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = last;
        last = row;
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

}  // namespace

std::string suggest(std::string_view name, const std::vector<std::string>& known) {
    if (known.empty()) return {};
    if (name.size() <= kLongestName) {
        const std::size_t limit = std::max<std::size_t>(1, name.size() / 3);
        std::size_t best = limit + 1;
        const std::string* nearest = nullptr;
        for (const std::string& candidate : known) {
            if (candidate.size() > name.size() + limit) continue;
            const std::size_t distance = edit_distance(name, candidate);
            if (distance < best) {
                best = distance;
                nearest = &candidate;
            }
        }
        if (nearest) return "did you mean \"" + *nearest + "\"?";
    }
    std::string list = "known: ";
    for (std::size_t k = 0; k < known.size() && k < kListed; ++k) list += (k == 0 ? "" : ", ") + known[k];
    if (known.size() > kListed) list += ", ...";
    return list;
}

}  // namespace headrace::proto
