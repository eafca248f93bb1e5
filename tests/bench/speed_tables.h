// speed.csv as tables: those of the README and of results/speed.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/speed_report.h"

namespace headrace::bench {

inline constexpr const char* kSpeedBegin = "<!-- made by `headrace_bench speed --readme` from speed.csv -->\n";
inline constexpr const char* kSpeedEnd = "<!-- end of speed.csv -->\n";

// The README with its tables made anew; nothing where it lacks the two marks.
std::optional<std::string> with_speed_tables(const std::string& readme, const std::vector<SpeedRow>& rows);

// results/speed.md: every case, strategy and size side by side.
std::string speed_document(const std::vector<SpeedRow>& rows);

}  // namespace headrace::bench
