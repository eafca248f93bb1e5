// Timings as lines for people and rows for programs.
#pragma once

#include <string>

#include "tests/bench/measure.h"

namespace headrace::bench {

std::string table_head();
std::string table_line(const Timing& timing);  // one line: the figures, then ms per step of each stage
std::string csv_head();
std::string csv_row(const Timing& timing);

}  // namespace headrace::bench
