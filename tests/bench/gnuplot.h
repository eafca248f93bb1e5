// Diagrams: commands piped to gnuplot, data blocks included.
#pragma once

#include <string>

namespace headrace::bench {

// Without it there are no diagrams, and that is said.
bool has_gnuplot();

// `what`: for the message when it fails.
bool run_gnuplot(const std::string& commands, const std::string& what);

}  // namespace headrace::bench
