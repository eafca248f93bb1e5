// Measurements of `headrace_bench speed` as tables: those of the README and of the documents beside them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/speed_report.h"

namespace headrace::bench {

// The lines between which the README has the tables of such a file; name: of the CSV file, without its folder.
std::string speed_begin(const std::string& name);
std::string speed_end(const std::string& name);

// The README with the tables of one file made anew; nothing where it lacks the two marks.
std::optional<std::string> with_speed_tables(const std::string& readme, const std::string& name,
                                             const std::vector<SpeedRow>& rows);

// The document beside the file: every case, strategy and size side by side.
std::string speed_document(const std::string& name, const std::vector<SpeedRow>& rows);

// Files of a folder that hold such measurements (speed*.csv, each of one machine and build), by name.
std::vector<std::string> find_speed_files(const std::string& folder);

}  // namespace headrace::bench
